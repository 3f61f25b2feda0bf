#include "import_check.h"

#include "base/error.h"
#include "import/import.h"
#include "require.h"
#include "scene/moving_boxes.h"
#include "scene/shape_instances.h"

namespace imgeo::fuzz {

namespace {

/// Requires that all indices are in range and that the scene is not empty.
void requireGraph(const Scene& scene) {
  const SceneGraph& graph = scene.graph;
  for (const Node& node : graph.nodes) {
    for (const std::size_t child : node.children)
      require(child < graph.nodes.size());
    if (const Humanoid* humanoid = std::get_if<Humanoid>(&node.content)) {
      require(humanoid->joints.size() == humanoid->inverseBindings.size());
      for (const std::size_t joint : humanoid->joints)
        require(joint < graph.nodes.size() && std::holds_alternative<Transform>(graph.nodes[joint].content));
    }
    if (const Shape* shape = std::get_if<Shape>(&node.content))
      require(shape->mesh < scene.meshes.size() &&
              (!shape->appearance || *shape->appearance < graph.appearances.size()));
  }
  for (const Appearance& appearance : graph.appearances)
    for (const TextureUse& use : appearance.textures)
      require(use.texture < graph.textures.size());
  for (const Texture& texture : graph.textures)
    require(texture.image < graph.images.size());
  require(graph.isComplete || !shapeInstances(graph).empty());
}

} // namespace

int importOrRefuse(const std::uint8_t* data, std::size_t size, const char* name) {
  try {
    const Imported imported = importBytes({data, size}, name, {.attributes = {.all = true, .names = {}}});
    requireGraph(imported.scene);
    if (imported.scene.graph.nodes.size() < 1000) { // poses take the joints of every vertex
      Scene posed = imported.scene;
      setMovingBoxes(posed);
    }
    for (const Mesh& mesh : imported.scene.meshes) {
      require(isConsistent(mesh));
      for (const Vec3f& position : mesh.positions)
        require(isFinite(position));
      for (const Vec3f& normal : mesh.normals)
        require(std::abs(length(Vec3d(normal)) - 1) < 1e-5);
      for (const NamedAttribute& attribute : mesh.namedAttributes)
        for (const float value : attribute.values)
          require(std::isfinite(value));
    }
  } catch (const Error& error) {
    require(!error.message().empty() && error.location().starts_with(name));
  }
  return 0;
}

} // namespace imgeo::fuzz
