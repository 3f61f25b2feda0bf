#include "scene/shape_instances.h"

#include "base/error.h"

#include <algorithm>

namespace imgeo {

namespace {

constexpr std::size_t maxShapeInstances = 1'000'000;

[[noreturn]] void failOfPlaces(const std::string& where) {
  throw Error(ErrorKind::limit, where, "the scene shows more than a million shapes");
}

/// Counts shapes in all their places, as far as there may be: each node is looked at once.
class PlaceCount {
public:
  explicit PlaceCount(const SceneGraph& graph) : graph_(graph), counts_(graph.nodes.size()) {}

  std::size_t below(const std::vector<std::size_t>& nodes) {
    std::size_t sum = 0;
    for (const std::size_t node : nodes)
      sum = std::min(sum + at(node), maxShapeInstances + 1);
    return sum;
  }

private:
  std::size_t at(std::size_t index) {
    if (counts_[index])
      return *counts_[index];
    const Node& node = graph_.nodes[index];
    const GenericNode* other = std::get_if<GenericNode>(&node.content);
    const bool isShape = std::holds_alternative<Shape>(node.content) || (other && other->element == "Shape");
    const std::size_t count = isShape ? 1 : below(node.children);
    counts_[index] = count;
    return count;
  }

  const SceneGraph& graph_;
  std::vector<std::optional<std::size_t>> counts_;
};

/// Lists the places of the shapes below a node. Nodes below which there are none
/// are visited once, however often they are USEd.
class Placing {
public:
  Placing(const SceneGraph& graph, const std::string& where)
      : graph_(graph), where_(where), isBare_(graph.nodes.size()) {}

  void place(std::size_t index, const Affine3d& worldFromParent) {
    if (isBare_[index])
      return;
    const Node& node = graph_.nodes[index];
    if (std::holds_alternative<Shape>(node.content)) {
      if (placed.size() == maxShapeInstances)
        failOfPlaces(where_);
      placed.push_back({index, worldFromParent});
      return;
    }
    const std::size_t before = placed.size();
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    for (const std::size_t child : node.children)
      place(child, worldFromNode);
    isBare_[index] = placed.size() == before;
  }

  std::vector<ShapeInstance> placed;

private:
  const SceneGraph& graph_;
  const std::string& where_;
  std::vector<bool> isBare_;
};

} // namespace

void checkShapeInstanceLimit(const SceneGraph& graph, const std::string& location) {
  if (PlaceCount(graph).below(graph.roots) > maxShapeInstances)
    failOfPlaces(location);
}

std::vector<ShapeInstance> shapeInstances(const SceneGraph& graph, const std::string& location) {
  Placing placing(graph, location);
  for (const std::size_t root : graph.roots)
    placing.place(root, {});
  return std::move(placing.placed);
}

} // namespace imgeo
