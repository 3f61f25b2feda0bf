#include "import/vrml1/indexed_sets.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <ranges>
#include <span>

namespace imgeo::vrml1 {

namespace {

/// The values of a list that are used, in ascending order, and the new indices of those.
class UsedValues {
public:
  void use(std::size_t index) { used_.push_back(index); }
  void finish() {
    std::ranges::sort(used_);
    used_.erase(std::ranges::unique(used_).begin(), used_.end());
  }
  std::size_t newIndex(std::size_t index) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(used_, index) - used_.begin());
  }
  const Indices& indices() const { return used_; }

  std::string text(const std::vector<double>& values, std::size_t size) const {
    fmt::memory_buffer text;
    for (const std::size_t index : used_)
      for (std::size_t i = 0; i < size; ++i)
        fmt::format_to(std::back_inserter(text), "{}{}", text.size() > 0 ? " " : "", values[index * size + i]);
    return fmt::to_string(text);
  }

private:
  Indices used_;
};

void appendIndex(fmt::memory_buffer& text, std::size_t index) {
  if (text.size() > 0)
    text.push_back(' ');
  if (index == noIndex)
    fmt::format_to(std::back_inserter(text), "-1");
  else
    fmt::format_to(std::back_inserter(text), "{}", index);
}

/// Texture coordinates where the source has none: the largest extent of the box is S, the second largest is T, and
/// both have the same scale.
std::string defaultTextureCoordinates(const std::vector<double>& points, const Indices& used) {
  std::array<double, 3> low{}, size{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto compare = [&](std::size_t a, std::size_t b) { return points[3 * a + axis] < points[3 * b + axis]; };
    const auto [min, max] = std::ranges::minmax_element(used, compare);
    low[axis] = points[3 * *min + axis];
    size[axis] = points[3 * *max + axis] - low[axis];
  }
  std::array<std::size_t, 3> axes{0, 1, 2};
  std::ranges::stable_sort(axes, [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
  const double scale = size[axes[0]] > 0 ? 1 / size[axes[0]] : 0;
  fmt::memory_buffer text;
  for (const std::size_t index : used)
    for (const std::size_t axis : {axes[0], axes[1]})
      fmt::format_to(std::back_inserter(text), "{}{:.6g}", text.size() > 0 ? " " : "",
                     (points[3 * index + axis] - low[axis]) * scale);
  return fmt::to_string(text);
}

/// What a list of colours does not express: everything but diffuse colour and transparency.
Surface withoutColor(Surface surface) {
  surface.diffuse = {};
  surface.transparency = 0;
  surface.ambientIntensity.reset();
  return surface;
}

/// Sets the fields that stand for ShapeHints, null for the defaults.
void setHints(pugi::xml_node geometry, const Node* hints, bool hasNormals) {
  const std::string ordering = hints ? hints->word("vertexOrdering", "") : "";
  if (ordering == "CLOCKWISE")
    x3d::set(geometry, "ccw", "false");
  const bool isSolid = hints && hints->word("shapeType", "") == "SOLID";
  if (!isSolid || (ordering != "CLOCKWISE" && ordering != "COUNTERCLOCKWISE"))
    x3d::set(geometry, "solid", "false");
  if (!hasNormals)
    x3d::set(geometry, "creaseAngle", fmt::format("{}", hints ? hints->real("creaseAngle", 0.5) : 0.5));
  if (hints && hints->word("faceType", "CONVEX") != "CONVEX")
    x3d::set(geometry, "convex", "false");
}

} // namespace

/// Faces whose materials differ in more than colour become shapes of their own; vertices cannot.
std::vector<std::vector<Run>> IndexedSets::groupedByMaterial(const IndexedContent& content) {
  if (!content.isSurface || content.materialIndex.empty() || !content.surfaces.differInMoreThanColor())
    return {content.runs};
  const auto surfaceOf = [&](std::size_t corner) {
    return withoutColor(content.surfaces.at(content.materialOf(corner)));
  };
  if (!content.isMaterialByRun) {
    const Surface first = surfaceOf(content.runs[0].begin);
    report_.mixedMaterials += !std::ranges::all_of(content.runs, [&](const Run& run) {
      return std::ranges::all_of(std::views::iota(run.begin, run.end),
                                 [&](std::size_t corner) { return surfaceOf(corner) == first; });
    });
    return {content.runs};
  }
  std::vector<Surface> surfaces;
  std::vector<std::vector<Run>> groups;
  for (const Run& run : content.runs) {
    const auto found = std::ranges::find(surfaces, surfaceOf(run.begin));
    const auto group = static_cast<std::size_t>(found - surfaces.begin());
    if (found == surfaces.end()) {
      surfaces.push_back(surfaceOf(run.begin));
      groups.emplace_back();
    }
    groups[group].push_back(run);
  }
  return groups;
}

void IndexedSets::add(pugi::xml_node parent, const Node& node, Properties& properties) {
  const std::optional<IndexedContent> content = readIndexedContent(node, properties, tokens_, report_);
  if (!content)
    return;
  for (const std::vector<Run>& runs : groupedByMaterial(*content))
    addShape(parent, node, *content, runs, properties);
}

void IndexedSets::addShape(pugi::xml_node parent, const Node& node, const IndexedContent& content,
                           const std::vector<Run>& runs, Properties& properties) {
  Indices materials; // that are used
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i < (content.isMaterialByRun ? run.begin + 1 : run.end); ++i)
      if (materials.empty() || materials.back() != content.materialOf(i))
        materials.push_back(content.materialOf(i));
  std::ranges::sort(materials);
  materials.erase(std::ranges::unique(materials).begin(), materials.end());
  Surface surface = content.surfaces.at(materials[0]);
  const auto hasSameColor = [&](std::size_t index) {
    const Surface other = content.surfaces.at(index);
    return other.transparency == surface.transparency &&
           (content.isSurface ? other.diffuse == surface.diffuse : unlitColor(other) == unlitColor(surface));
  };
  if (std::ranges::all_of(materials, hasSameColor))
    materials.clear();
  else
    surface.transparency = 0; // in the colours
  pugi::xml_node shape = elements_.add(parent, "Shape", node.where);
  if (!node.name.empty())
    x3d::set(shape, "DEF", elements_.define(node.name, "Shape"));
  appearances_.add(shape, node, surface, content.isSurface, properties);

  if (runs.size() < content.runs.size() || !materials.empty())
    return addGeometry(shape, node, content, runs, materials);
  const auto [found, isNew] = written_.try_emplace(content.key);
  if (isNew) {
    addGeometry(shape, node, content, runs, materials);
    found->second = shape.last_child();
    return;
  }
  pugi::xml_node written = found->second;
  if (!written.attribute("DEF"))
    x3d::set(written, "DEF", elements_.define(node.type, node.type));
  x3d::set(elements_.add(shape, node.type, node.where), "USE", written.attribute("DEF").value());
}

void IndexedSets::addGeometry(pugi::xml_node shape, const Node& node, const IndexedContent& content,
                              const std::vector<Run>& runs, const Indices& colors) {
  UsedValues points, normals, texCoords;
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i < run.end; ++i) {
      points.use(content.coordIndex[i]);
      if (content.normals)
        normals.use(content.normalIndex[i]);
      if (content.texCoords)
        texCoords.use(content.texCoordIndex[i]);
    }
  points.finish();
  normals.finish();
  texCoords.finish();

  pugi::xml_node geometry = elements_.add(shape, node.type, node.where);
  if (content.isSurface)
    setHints(geometry, content.hints, content.normals != nullptr);
  const auto colorOf = [&](std::size_t corner) {
    return static_cast<std::size_t>(std::ranges::lower_bound(colors, content.materialOf(corner)) - colors.begin());
  };
  fmt::memory_buffer coordIndex, normalIndex, texCoordIndex, colorIndex;
  bool areNormalsByPoint = true, areTexCoordsByPoint = true;
  for (const Run& run : runs) {
    for (std::size_t i = run.begin; i < run.end; ++i) {
      const std::size_t point = points.newIndex(content.coordIndex[i]);
      appendIndex(coordIndex, point);
      if (content.normals) {
        const std::size_t normal = normals.newIndex(content.normalIndex[i]);
        areNormalsByPoint &= normal == point;
        appendIndex(normalIndex, normal);
      }
      if (content.texCoords) {
        const std::size_t texCoord = texCoords.newIndex(content.texCoordIndex[i]);
        areTexCoordsByPoint &= texCoord == point;
        appendIndex(texCoordIndex, texCoord);
      }
      if (!colors.empty() && (!content.isMaterialByRun || i == run.begin))
        appendIndex(colorIndex, colorOf(i));
    }
    for (fmt::memory_buffer* index : {&coordIndex, &normalIndex, &texCoordIndex})
      appendIndex(*index, noIndex);
    if (!content.isMaterialByRun)
      appendIndex(colorIndex, noIndex);
  }
  if (!content.isPoints)
    x3d::set(geometry, "coordIndex", fmt::to_string(coordIndex));
  if (content.normals && !areNormalsByPoint)
    x3d::set(geometry, "normalIndex", fmt::to_string(normalIndex));
  if (content.texCoords && !areTexCoordsByPoint)
    x3d::set(geometry, "texCoordIndex", fmt::to_string(texCoordIndex));
  if (!colors.empty() && !content.isPoints) {
    x3d::set(geometry, "colorIndex", fmt::to_string(colorIndex));
    if (content.isMaterialByRun)
      x3d::set(geometry, "colorPerVertex", "false");
  }

  x3d::set(elements_.add(geometry, "Coordinate", node.where), "point", points.text(*content.points, 3));
  if (content.normals)
    x3d::set(elements_.add(geometry, "Normal", node.where), "vector", normals.text(*content.normals, 3));
  if (content.texCoords)
    x3d::set(elements_.add(geometry, "TextureCoordinate", node.where), "point", texCoords.text(*content.texCoords, 2));
  else if (content.isTextured)
    x3d::set(elements_.add(geometry, "TextureCoordinate", node.where), "point",
             defaultTextureCoordinates(*content.points, points.indices()));
  if (!colors.empty())
    addColors(geometry, node, content, runs, colors);
}

void IndexedSets::addColors(pugi::xml_node geometry, const Node& node, const IndexedContent& content,
                            const std::vector<Run>& runs, const Indices& colors) {
  const bool hasAlpha =
      std::ranges::any_of(colors, [&](std::size_t index) { return content.surfaces.at(index).transparency != 0; });
  fmt::memory_buffer text;
  const auto addColor = [&](std::size_t index) {
    const Surface surface = content.surfaces.at(index);
    fmt::format_to(std::back_inserter(text), "{}{}", text.size() > 0 ? " " : "",
                   textOf(content.isSurface ? surface.diffuse : unlitColor(surface)));
    if (hasAlpha)
      fmt::format_to(std::back_inserter(text), " {}", 1 - surface.transparency);
  };
  if (content.isPoints) // PointSet has no colorIndex
    for (const Run& run : runs)
      for (std::size_t i = run.begin; i < run.end; ++i)
        addColor(content.materialOf(i));
  else
    std::ranges::for_each(colors, addColor);
  x3d::set(elements_.add(geometry, hasAlpha ? "ColorRGBA" : "Color", node.where), "color", fmt::to_string(text));
}

} // namespace imgeo::vrml1
