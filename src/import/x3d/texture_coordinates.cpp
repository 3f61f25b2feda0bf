#include "import/x3d/texture_coordinates.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numbers>
#include <set>

namespace imgeo::x3d {

namespace {

bool isTexCoordSet(std::string_view element) {
  return element == "TextureCoordinate" || element == "TextureCoordinateGenerator";
}

/// The modes that depend on positions; all others depend on normals.
constexpr std::array<std::string_view, 5> positionModes{"COORD", "COORD-EYE", "CAMERASPACEPOSITION", "NOISE",
                                                        "NOISE-EYE"};

} // namespace

std::vector<pugi::xml_node> texCoordNodes(const Source& source, pugi::xml_node geometry) {
  std::vector<pugi::xml_node> nodes;
  for (const pugi::xml_node& child : geometry.children()) {
    const std::string_view name = child.name();
    if (isTexCoordSet(name)) {
      nodes.push_back(source.resolved(child));
      break;
    }
    if (name == "MultiTextureCoordinate") {
      for (const pugi::xml_node& set : source.resolved(child).children())
        if (isTexCoordSet(set.name()))
          nodes.push_back(source.resolved(set));
      break;
    }
  }
  return nodes;
}

void addTextureMappings(const Source& source, AttributeChoice& kept) {
  struct Walker : pugi::xml_tree_walker {
    explicit Walker(std::set<std::string>& into) : names(into) {}
    bool for_each(pugi::xml_node& node) override {
      for (const pugi::xml_attribute& attribute : node.attributes())
        if (std::string_view(attribute.name()).ends_with("TextureMapping"))
          names.insert(attribute.value());
      return true;
    }
    std::set<std::string>& names;
  };
  Walker walker(kept.names);
  source.root().traverse(walker);
}

std::optional<TexCoordGenerator> texCoordGeneratorOf(pugi::xml_node node) {
  if (std::string_view(node.name()) != "TextureCoordinateGenerator")
    return {};
  const std::string mode = node.attribute("mode").as_string("SPHERE");
  const bool usesPositions = std::ranges::find(positionModes, mode) != positionModes.end();
  TexCoordGenerator generator{usesPositions ? TexCoordMode::coord : TexCoordMode::sphereLocal, ""};
  if (mode != (usesPositions ? "COORD" : "SPHERE-LOCAL"))
    generator.approximated = mode;
  return generator;
}

void addDefaultTexCoords(VertexData& data, Faces& faces) {
  Box3d box;
  for (const Vec3f& position : data.positions)
    box.add(Vec3d(position));
  const Vec3d size = box.max - box.min;
  std::array<int, 3> axes{0, 1, 2};
  std::ranges::stable_sort(axes, std::greater(), [&](int axis) { return size[axis]; });
  const double scale = size[axes[0]] > 0 ? 1 / size[axes[0]] : 1;
  data.texCoords.clear();
  for (const Vec3f& position : data.positions) {
    const Vec3d fromMin = (Vec3d(position) - box.min) * scale;
    data.texCoords.push_back({static_cast<float>(fromMin[axes[0]]), static_cast<float>(fromMin[axes[1]])});
  }
  for (Corner& corner : faces.corners)
    corner.texCoord = corner.position;
}

void addGeneratedTexCoords(TexCoordMode mode, VertexData& data, Faces& faces) {
  const bool usesNormals = mode == TexCoordMode::sphereLocal;
  if (usesNormals && faces.topology != Topology::triangles)
    return;
  if (usesNormals && data.normals.empty())
    addCreaseNormals(data, faces, std::numbers::pi);
  data.texCoords.clear();
  for (const Vec3f& value : usesNormals ? data.normals : data.positions)
    data.texCoords.push_back(usesNormals ? Vec2f{value.x / 2 + 0.5f, value.y / 2 + 0.5f} : Vec2f{value.x, value.y});
  for (Corner& corner : faces.corners)
    corner.texCoord = usesNormals ? corner.normal : corner.position;
}

} // namespace imgeo::x3d
