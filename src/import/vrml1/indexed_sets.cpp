#include "import/vrml1/indexed_sets.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <iterator>
#include <ranges>
#include <span>

namespace imgeo::vrml1 {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);
constexpr double maxIndex = 4294967295;
using Indices = std::vector<std::size_t>;

/// The indices of a field, `none` for negative numbers. Empty for the default, a single -1.
Indices indicesOf(const Node& node, const char* field) {
  const std::vector<double>& numbers = node.numbers(field);
  Indices indices(numbers.size(), none);
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (numbers[i] >= 0)
      indices[i] = static_cast<std::size_t>(std::min(numbers[i], maxIndex));
  return indices == Indices{none} ? Indices{} : indices;
}

bool isByVertex(const std::string& binding) {
  return binding.starts_with("PER_VERTEX");
}

std::vector<Run> runsOf(const Indices& coordIndex) {
  std::vector<Run> runs;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= coordIndex.size(); ++i)
    if (i == coordIndex.size() || coordIndex[i] == none) {
      if (i > begin)
        runs.push_back({begin, i, runs.size()});
      begin = i + 1;
    }
  return runs;
}

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
  if (index == none)
    fmt::format_to(std::back_inserter(text), "-1");
  else
    fmt::format_to(std::back_inserter(text), "{}", index);
}

/// Texture coordinates where the source has none: the largest extent of the box is S, the second largest is T, and both
/// have the same scale.
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

/// The corners of a node and what they use. Attributes have an index for each corner of coordIndex, or none.
struct IndexedSets::Content {
  bool isSurface = false, isPoints = false, isTextured = false;
  Indices coordIndex;
  std::vector<Run> allRuns; ///< of which bindings count the degenerate ones too
  std::vector<Run> runs;
  const std::vector<double>*points = nullptr, *normals = nullptr, *texCoords = nullptr; ///< null: none
  Indices normalIndex, texCoordIndex;
  Indices materialIndex;       ///< of each corner; empty where one material is bound to all
  bool isMaterialByRun = true; ///< whether the corners of a run have the same material
  Surfaces surfaces{nullptr};
  const Node* hints = nullptr;
  std::string key; ///< the node and all that its geometry uses, but for materials

  std::size_t materialOf(std::size_t corner) const {
    return materialIndex.empty() ? 0 : materialIndex[corner] % surfaces.count();
  }
};

bool IndexedSets::isInRange(const Node& node, std::size_t index, std::size_t count, const char* what) {
  if (index < count)
    return true;
  report_.omissions.push_back(fmt::format("{}: {}: left out: {}.", tokens_.locationOf(node.where), node.type,
                                          index == none ? fmt::format("has corners without a {}", what)
                                                        : fmt::format("names {} {} of {}", what, index, count)));
  return false;
}

bool IndexedSets::readContent(const Node& node, Properties& properties, Content& content) {
  static const std::vector<double> origin{0, 0, 0};
  content.isSurface = node.is("IndexedFaceSet");
  content.isPoints = node.is("PointSet");
  const Node* const coordinates = properties.get(Property::coordinates);
  content.points = coordinates && coordinates->field("point") ? &coordinates->numbers("point") : &origin;
  const std::size_t pointCount = content.points->size() / 3;
  if (content.isPoints) {
    const auto first =
        static_cast<std::size_t>(std::clamp(node.real("startIndex", 0), 0.0, static_cast<double>(pointCount)));
    const double count = node.real("numPoints", -1);
    const std::size_t end = count < 0 ? pointCount : first + static_cast<std::size_t>(std::min(count, maxIndex));
    if (end > first && !isInRange(node, end - 1, pointCount, "point"))
      return false;
    for (std::size_t i = first; i < end; ++i)
      content.coordIndex.push_back(i);
  } else {
    content.coordIndex = indicesOf(node, "coordIndex");
  }
  content.allRuns = runsOf(content.coordIndex);
  const std::size_t minCorners = content.isSurface ? 3 : content.isPoints ? 1 : 2;
  std::ranges::copy_if(content.allRuns, std::back_inserter(content.runs),
                       [&](const Run& run) { return run.end - run.begin >= minCorners; });
  for (const std::size_t index : content.coordIndex)
    if (index != none && !isInRange(node, index, pointCount, "point"))
      return false;
  content.key = fmt::format("{} {}", fmt::ptr(&node), fmt::ptr(coordinates));
  return true;
}

namespace {

/// Gives each corner the index that a binding says. Empty for a binding to the whole shape.
Indices boundIndices(const std::string& binding, const Indices& given, const Indices& coordIndex,
                     const std::vector<Run>& runs) {
  Indices indices(coordIndex.size(), none);
  const bool isIndexed = binding.ends_with("_INDEXED");
  if (isByVertex(binding)) {
    std::size_t corner = 0;
    for (const Run& run : runs)
      for (std::size_t i = run.begin; i < run.end; ++i, ++corner)
        if (!isIndexed)
          indices[i] = corner;
        else if (given.empty())
          indices[i] = coordIndex[i];
        else if (i < given.size())
          indices[i] = given[i];
    return indices;
  }
  if (!binding.starts_with("PER_FACE") && !binding.starts_with("PER_PART"))
    return {};
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i < run.end; ++i)
      indices[i] = !isIndexed || given.empty() ? run.number : run.number < given.size() ? given[run.number] : none;
  return indices;
}

/// The value of a MaterialBinding or NormalBinding.
std::string bindingOf(const Node* binding) {
  return binding ? binding->word("value", "DEFAULT") : "DEFAULT";
}

/// The single lines of polylines.
std::vector<Run> segmentsOf(const std::vector<Run>& runs) {
  std::vector<Run> segments;
  for (const Run& run : runs)
    for (std::size_t i = run.begin; i + 1 < run.end; ++i)
      segments.push_back({i, i + 2, segments.size()});
  return segments;
}

bool areBelow(std::size_t count, const Indices& indices, const std::vector<Run>& runs) {
  return std::ranges::all_of(runs, [&](const Run& run) {
    return std::ranges::all_of(std::span(indices).subspan(run.begin, run.end - run.begin),
                               [&](std::size_t index) { return index < count; });
  });
}

} // namespace

bool IndexedSets::bindMaterials(const Node& node, Properties& properties, Content& content) {
  content.surfaces = Surfaces(properties.get(Property::material));
  if (content.surfaces.count() == 1)
    return true;
  std::string binding = bindingOf(properties.get(Property::materialBinding));
  if (content.isPoints && binding.starts_with("PER_")) // each point is a part, a face and a vertex
    binding = "PER_VERTEX";
  if (node.is("IndexedLineSet") && binding.starts_with("PER_PART"))
    content.runs = content.allRuns = segmentsOf(content.runs);
  content.isMaterialByRun = !isByVertex(binding);
  content.materialIndex = boundIndices(binding, indicesOf(node, "materialIndex"), content.coordIndex, content.allRuns);
  if (content.materialIndex.empty())
    return true;
  for (const Run& run : content.runs)
    for (std::size_t i = run.begin; i < run.end; ++i)
      if (!isInRange(node, content.materialIndex[i], none, "material")) // indices are cycled
        return false;
  return true;
}

/// Normals count only where there are enough of them; otherwise they are computed by crease angle.
void IndexedSets::bindNormals(const Node& node, Properties& properties, Content& content) {
  const Node* const normals = properties.get(Property::normals);
  if (!normals)
    return;
  const Node* const bindingNode = properties.get(Property::normalBinding);
  std::string binding = bindingOf(bindingNode);
  if (binding == "DEFAULT")
    binding = "PER_VERTEX_INDEXED";
  content.normalIndex = boundIndices(binding, indicesOf(node, "normalIndex"), content.coordIndex, content.allRuns);
  if (content.normalIndex.empty())
    content.normalIndex.assign(content.coordIndex.size(), 0);
  if (areBelow(normals->numbers("vector").size() / 3, content.normalIndex, content.runs))
    content.normals = &normals->numbers("vector");
  content.key += fmt::format(" {} {}", fmt::ptr(normals), fmt::ptr(bindingNode));
}

bool IndexedSets::bindTextureCoordinates(const Node& node, Properties& properties, Content& content) {
  content.isTextured = Appearances::isTextured(properties);
  if (!content.isTextured)
    return true;
  const Node* const texCoords = properties.get(Property::textureCoordinates);
  content.key += fmt::format(" textured {}", fmt::ptr(texCoords));
  const std::size_t count = texCoords ? texCoords->numbers("point").size() / 2 : 0;
  if (count == 0)
    return true;
  content.texCoords = &texCoords->numbers("point");
  content.texCoordIndex =
      boundIndices("PER_VERTEX_INDEXED", indicesOf(node, "textureCoordIndex"), content.coordIndex, content.allRuns);
  for (const Run& run : content.runs)
    for (std::size_t i = run.begin; i < run.end; ++i)
      if (!isInRange(node, content.texCoordIndex[i], count, "texture coordinate"))
        return false;
  return true;
}

/// Faces whose materials differ in more than colour become shapes of their own; vertices cannot.
std::vector<std::vector<Run>> IndexedSets::groupedByMaterial(const Content& content) {
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
  Content content;
  if (!readContent(node, properties, content) || content.runs.empty() || !bindMaterials(node, properties, content))
    return;
  if (content.isSurface) {
    content.hints = properties.get(Property::shapeHints);
    content.key += fmt::format(" {}", fmt::ptr(content.hints));
    bindNormals(node, properties, content);
    if (!bindTextureCoordinates(node, properties, content))
      return;
  }
  for (const std::vector<Run>& runs : groupedByMaterial(content))
    addShape(parent, node, content, runs, properties);
}

void IndexedSets::addShape(pugi::xml_node parent, const Node& node, const Content& content,
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

void IndexedSets::addGeometry(pugi::xml_node shape, const Node& node, const Content& content,
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
      appendIndex(*index, none);
    if (!content.isMaterialByRun)
      appendIndex(colorIndex, none);
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

void IndexedSets::addColors(pugi::xml_node geometry, const Node& node, const Content& content,
                            const std::vector<Run>& runs, const std::vector<std::size_t>& colors) {
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
