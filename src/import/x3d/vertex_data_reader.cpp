#include "import/x3d/vertex_data_reader.h"

#include "import/mesh/unit_normal.h"
#include "scene/fog_depths.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <iterator>
#include <utility>

namespace imgeo::x3d {

namespace {

class VertexDataReader {
public:
  VertexDataReader(const Source& source, pugi::xml_node node, const AttributeChoice& kept)
      : source_(source), node_(node), kept_(kept) {}

  NodeVertexData read() {
    VertexData& data = read_.data;
    data.positions = vectors(childNamed({"Coordinate", "CoordinateDouble"}), "point");
    data.normals = vectors(childNamed({"Normal"}), "vector");
    for (Vec3f& normal : data.normals)
      makeUnit(normal);
    readTexCoords();
    const pugi::xml_node color = childNamed({"Color", "ColorRGBA"});
    const std::size_t components = std::string_view(color.name()) == "ColorRGBA" ? 4 : 3;
    const std::vector<double> colors = tuplesOf(source_, color, "color", components);
    for (std::size_t i = 0; i < colors.size(); i += components)
      data.colors.emplace_back(channelOf(colors[i]), channelOf(colors[i + 1]), channelOf(colors[i + 2]),
                               components == 4 ? channelOf(colors[i + 3]) : 1);
    const bool isOpaque = std::ranges::all_of(data.colors, [](const Rgba& c) { return c.a == 1; });
    data.colorComponents = isOpaque ? 3 : 4;
    if (kept_.has(fogDepthName))
      if (const std::vector<double> depths = source_.reals(childNamed({"FogCoordinate"}), "depth"); !depths.empty())
        data.pointAttributes.push_back({fogDepthName, 1, {depths.begin(), depths.end()}});
    if (const std::vector<NamedAttribute>* ofSkin = source_.pointAttributesOf(node_))
      std::ranges::copy(*ofSkin, std::back_inserter(data.pointAttributes));
    return std::move(read_);
  }

private:
  /// The first child with one of these names, its USE resolved.
  pugi::xml_node childNamed(std::initializer_list<const char*> names) const {
    for (const pugi::xml_node& child : node_.children())
      for (const char* name : names)
        if (std::string_view(child.name()) == name)
          return source_.resolved(child);
    return {};
  }

  std::vector<Vec3f> vectors(pugi::xml_node from, const char* field) const {
    const std::vector<double> values = tuplesOf(source_, from, field, 3);
    std::vector<Vec3f> vectors;
    for (std::size_t i = 0; i < values.size(); i += 3)
      vectors.push_back(Vec3f(Vec3d{values[i], values[i + 1], values[i + 2]}));
    return vectors;
  }

  /// Reads the first set of texture coordinates, and of the others those whose name a texture states as its mapping
  /// (X3D 4, 18.4.1).
  void readTexCoords() {
    const std::vector<pugi::xml_node> sets = texCoordNodes(source_, node_);
    if (sets.empty())
      return;
    read_.furtherTexCoords = sets.size() - 1;
    read_.texCoordGenerator = texCoordGeneratorOf(sets[0]);
    if (read_.texCoordGenerator)
      return;
    read_.data.texCoords = texCoordsOf(sets[0]);
    std::vector<std::string> mappings{sets[0].attribute("mapping").value()};
    for (std::size_t i = 1; i < sets.size(); ++i) {
      const std::string mapping = sets[i].attribute("mapping").value();
      const bool isUsed = !texCoordGeneratorOf(sets[i]) && mappings.size() < maxTexCoordSets && kept_.has(mapping) &&
                          std::ranges::find(mappings, mapping) == mappings.end();
      if (!isUsed || read_.data.texCoords.empty())
        continue;
      read_.data.furtherTexCoords.push_back(texCoordsOf(sets[i]));
      mappings.push_back(mapping);
      --read_.furtherTexCoords;
    }
    if (!read_.data.furtherTexCoords.empty())
      read_.data.texCoordMappings = mappings;
  }

  std::vector<Vec2f> texCoordsOf(pugi::xml_node node) const {
    std::vector<Vec2f> texCoords;
    const std::vector<double> points = tuplesOf(source_, node, "point", 2);
    for (std::size_t i = 0; i < points.size(); i += 2)
      texCoords.push_back({static_cast<float>(points[i]), static_cast<float>(points[i + 1])});
    return texCoords;
  }

  const Source& source_;
  pugi::xml_node node_;
  const AttributeChoice& kept_;
  NodeVertexData read_;
};

} // namespace

std::vector<double> tuplesOf(const Source& source, pugi::xml_node from, const char* field, std::size_t size) {
  std::vector<double> values = source.reals(from, field);
  if (values.size() % size != 0)
    source.fail(from, ErrorKind::malformed,
                fmt::format("{} has {} numbers, which are not {} each", field, values.size(), size));
  return values;
}

NodeVertexData readVertexData(const Source& source, pugi::xml_node geometry, const AttributeChoice& kept) {
  return VertexDataReader(source, geometry, kept).read();
}

} // namespace imgeo::x3d
