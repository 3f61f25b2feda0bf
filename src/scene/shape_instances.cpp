#include "scene/shape_instances.h"

#include "base/error.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::size_t maxShapeInstances = 1'000'000;

[[noreturn]] void failAtLimit(const std::string& location) {
  throw Error(ErrorKind::limit, location, "the scene shows more than a million shapes");
}

/// Counts shape instances up to the limit. Visits each node once.
class InstanceCounter {
public:
  explicit InstanceCounter(const SceneGraph& graph) : graph_(graph), counts_(graph.nodes.size()) {}

  /// The number of instances in the subtrees of `nodes`; one more than the limit for any number above it.
  std::size_t countInSubtrees(const std::vector<std::size_t>& nodes) {
    std::size_t sum = 0;
    for (const std::size_t node : nodes)
      sum = std::min(sum + countInSubtree(node), maxShapeInstances + 1);
    return sum;
  }

private:
  std::size_t countInSubtree(std::size_t index) {
    if (counts_[index])
      return *counts_[index];
    const Node& node = graph_.nodes[index];
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    const bool isShape = std::holds_alternative<Shape>(node.content) || (generic && generic->element == "Shape");
    const std::size_t count = isShape ? 1 : countInSubtrees(node.children);
    counts_[index] = count;
    return count;
  }

  const SceneGraph& graph_;
  std::vector<std::optional<std::size_t>> counts_; ///< by node: instances in its subtree
};

/// Lists the shape instances below nodes. A node without shapes below it is visited once, even if it is USEd several
/// times.
class InstanceCollector {
public:
  InstanceCollector(const SceneGraph& graph, const std::string& location)
      : graph_(graph), location_(location), hasNoShapes_(graph.nodes.size()) {}

  void collect(std::size_t index, const Affine3d& worldFromParent) {
    if (hasNoShapes_[index])
      return;
    const Node& node = graph_.nodes[index];
    if (std::holds_alternative<Shape>(node.content)) {
      if (instances.size() == maxShapeInstances)
        failAtLimit(location_);
      instances.push_back({index, worldFromParent});
      return;
    }
    const std::size_t before = instances.size();
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    for (const std::size_t child : node.children)
      collect(child, worldFromNode);
    hasNoShapes_[index] = instances.size() == before;
  }

  std::vector<ShapeInstance> instances;

private:
  const SceneGraph& graph_;
  const std::string& location_;
  std::vector<bool> hasNoShapes_; ///< by node: its subtree has no shapes
};

} // namespace

bool isDrawable(const Affine3d& worldFromShape) {
  constexpr double minScale = 1 / maxDrawableLength, maxScale = maxDrawableLength;
  for (const Vec3d& axis : {worldFromShape.x, worldFromShape.y, worldFromShape.z}) {
    const double scale = length(axis);
    if (!(scale <= maxScale) || (scale > 0 && scale < minScale))
      return false;
  }
  return length(worldFromShape.translation) <= maxScale;
}

void checkShapeInstanceLimit(const SceneGraph& graph, const std::string& location) {
  if (InstanceCounter(graph).countInSubtrees(graph.roots) > maxShapeInstances)
    failAtLimit(location);
}

std::vector<ShapeInstance> shapeInstances(const SceneGraph& graph, const std::string& location) {
  InstanceCollector collector(graph, location);
  for (const std::size_t root : graph.roots)
    collector.collect(root, {});
  return std::move(collector.instances);
}

} // namespace imgeo
