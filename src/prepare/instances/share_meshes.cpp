#include "prepare/instances/share_meshes.h"

#include "prepare/instances/find_instances.h"
#include "scene/skin.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

namespace imgeo {

namespace {

/// What is known of the shapes of a mesh.
struct MeshUse {
  bool isUsed = false, mayMove = true;
  std::set<bool> solids;
  std::set<std::optional<std::size_t>> appearances;
};

/// Whether a node may have a Transform where it has a Shape.
bool maySurroundTransform(const Node& node) {
  if (const Transform* transform = std::get_if<Transform>(&node.content))
    return !transform->isJoint;
  if (const GenericNode* generic = std::get_if<GenericNode>(&node.content)) {
    constexpr std::array<std::string_view, 7> grouping{"Anchor",        "Billboard",   "Collision", "LOD",
                                                       "PickableGroup", "StaticGroup", "Switch"};
    return std::ranges::find(grouping, generic->element) != grouping.end();
  }
  return std::holds_alternative<Group>(node.content);
}

/// Whether the author has stated of a Shape what depends on its coordinates or on its parent.
bool isBound(const Node& shape) {
  return std::ranges::any_of(shape.fields, [](const FieldText& field) {
    return field.name == "containerField" || field.name == "bboxCenter" || field.name == "bboxSize";
  });
}

/// Nodes of the scene's own document: what they are children of.
class Parents {
public:
  explicit Parents(const SceneGraph& graph) : allowed_(graph.nodes.size()), forbidden_(graph.nodes.size()) {
    for (const std::size_t root : graph.roots)
      allowed_[root] = true;
    for (const std::size_t node : nodesInOrder(graph))
      for (const std::size_t child : graph.nodes[node].children)
        (maySurroundTransform(graph.nodes[node]) ? allowed_ : forbidden_)[child] = true;
    std::vector<bool> isOwn(graph.nodes.size());
    for (const std::size_t node : nodesOfDocument(graph, graph.roots))
      isOwn[node] = true;
    for (std::size_t node = 0; node < isOwn.size(); ++node)
      if (!isOwn[node])
        forbidden_[node] = true;
    for (const Route& route : graph.routes) // whose fields may be the author's
      forbidden_[route.fromNode] = forbidden_[route.toNode] = true;
  }
  bool mayBecomeTransforms(std::size_t node) const { return allowed_[node] && !forbidden_[node]; }

private:
  std::vector<bool> allowed_, forbidden_;
};

std::vector<MeshUse> usesOf(const Scene& scene, std::span<const std::size_t> excluded) {
  const SceneGraph& graph = scene.graph;
  const Parents parents(graph);
  std::vector<MeshUse> uses(scene.meshes.size());
  for (const std::size_t node : shapeNodes(graph)) {
    const Shape& shape = shapeOf(graph, node);
    MeshUse& use = uses[shape.mesh];
    use.isUsed = true;
    use.mayMove =
        use.mayMove && parents.mayBecomeTransforms(node) && !isBound(graph.nodes[node]) && shape.movingBox.empty();
    use.solids.insert(shape.solid);
    use.appearances.insert(shape.appearance);
  }
  for (const std::size_t mesh : excluded)
    uses[mesh].isUsed = false;
  return uses;
}

/// Puts Shapes into Transforms.
class ShapeMover {
public:
  explicit ShapeMover(SceneGraph& graph) : graph_(graph), transforms_(graph.nodes.size()) {
    for (const Route& route : graph.routes)
      routed_.insert({route.fromNode, route.toNode});
  }

  void move(std::size_t shape, const Transform& transform) { transforms_[shape] = transform; }

  void finish() {
    std::vector<std::optional<std::size_t>> wrappers(transforms_.size());
    const auto wrapped = [&](std::size_t child) {
      if (child >= transforms_.size() || !transforms_[child])
        return child;
      if (!wrappers[child])
        wrappers[child] = addNode(graph_, {"", *transforms_[child], {child}, ""});
      return *wrappers[child];
    };
    for (const std::size_t index : nodesInOrder(graph_)) {
      if (Node& node = graph_.nodes[index]; isGroupOfOne(index) && transforms_[node.children[0]]) {
        node.content = *transforms_[node.children[0]];
        continue;
      }
      std::vector<std::size_t> children = graph_.nodes[index].children;
      for (std::size_t& child : children)
        child = wrapped(child);
      graph_.nodes[index].children = std::move(children);
    }
    for (std::size_t& root : graph_.roots)
      root = wrapped(root);
  }

private:
  bool isGroupOfOne(std::size_t index) const {
    const Node& node = graph_.nodes[index];
    return std::holds_alternative<Group>(node.content) && node.children.size() == 1 && node.fields.empty() &&
           !routed_.contains(index);
  }

  SceneGraph& graph_;
  std::vector<std::optional<Transform>> transforms_; ///< by node: that of a Shape that moves
  std::set<std::size_t> routed_;
};

} // namespace

SharedMeshes shareMeshes(Scene& scene, const SharingOptions& options, std::span<const std::size_t> excluded,
                         const StoredMeshes* stored) {
  const SceneMeshes meshes(scene.meshes, stored);
  const std::vector<MeshUse> uses = usesOf(scene, excluded);
  InstanceSearch search{{}, {}, options.tolerance, {}, options.minSmallClass};
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const MeshUse& use = uses[i];
    const Mesh& mesh = scene.meshes[i]; // of a stored one a part
    const std::size_t elements = meshes.elementCount(i);
    std::optional<std::uint64_t> kind;
    const bool needsAppearance = !mesh.texCoords.empty() && elements > options.maxTexturedElements;
    if (use.isUsed && use.mayMove && use.solids.size() == 1 && !isDeformed(mesh) &&
        (!needsAppearance || use.appearances.size() == 1)) {
      const std::optional<std::size_t> appearance = needsAppearance ? *use.appearances.begin() : std::nullopt;
      kind = 2 * (appearance ? *appearance + 1 : 0) + *use.solids.begin();
    }
    search.kinds.push_back(kind);
    search.small.push_back(elements < options.minElements);
  }
  std::vector<bool> isListed(scene.meshes.size());
  for (const std::size_t node : shapeNodes(scene.graph))
    if (const std::size_t mesh = shapeOf(scene.graph, node).mesh; search.kinds[mesh] && !isListed[mesh]) {
      isListed[mesh] = true;
      search.order.push_back(mesh);
    }
  const std::vector<std::optional<MeshInstance>> instances = findInstances(meshes, search);

  SharedMeshes shared;
  ShapeMover mover(scene.graph);
  for (const std::size_t node : shapeNodes(scene.graph)) {
    Shape& shape = std::get<Shape>(scene.graph.nodes[node].content);
    const std::optional<MeshInstance>& instance = instances[shape.mesh];
    if (!instance)
      continue;
    shape.mesh = instance->mesh;
    ++shared.shapes;
    if (instance->transform != Transform{})
      mover.move(node, instance->transform);
  }
  mover.finish();
  for (std::size_t i = 0; i < instances.size(); ++i)
    if (instances[i]) {
      shared.distance = std::max(shared.distance, instances[i]->distance);
      ++shared.meshes;
      scene.meshes[i] = {};
    }
  return shared;
}

} // namespace imgeo
