#include "transcode/verify/gltf_targets.h"

#include "base/error.h"

#include <set>
#include <utility>

namespace imgeo {

namespace {

constexpr std::size_t maxNodeInstances = 4'000'000;

class TargetFinder {
public:
  TargetFinder(const SceneGraph& graph, const std::vector<GltfChannel>& channels)
      : graph_(graph), hasNone_(graph.nodes.size()) {
    for (const GltfChannel& channel : channels)
      moved_.insert(channel.value->toNode);
    for (const Node& node : graph.nodes)
      if (const Humanoid* humanoid = std::get_if<Humanoid>(&node.content))
        joints_.insert(humanoid->joints.begin(), humanoid->joints.end());
    for (const std::size_t root : graph.roots)
      visit(root, {});
  }

  GltfTargets targets() && {
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> counts; ///< of Transforms, by their shapes
    for (const auto& [node, worldFromParent, firstShape, endShape, hasAny] : transforms_)
      if (hasAny)
        targets_.ofNode[node].push_back({{firstShape, endShape, counts[{firstShape, endShape}]++}, worldFromParent});
    return std::move(targets_);
  }

private:
  struct Visited {
    std::size_t node = 0;
    Affine3d worldFromParent;
    std::size_t firstShape = 0, endShape = 0;
    bool hasAny = false; ///< shapes or joints
  };

  /// Returns whether there are shapes or joints in the subtree.
  bool visit(std::size_t index, const Affine3d& worldFromParent) {
    if (hasNone_[index])
      return false;
    if (++visits_ > maxNodeInstances)
      throw Error(ErrorKind::limit, "", "the scene has more than four million instances of nodes");
    const Node& node = graph_.nodes[index];
    if (std::holds_alternative<Shape>(node.content)) {
      addDisplacers(node);
      return true;
    }
    const std::size_t slot = transforms_.size();
    const bool isMoved = moved_.contains(index);
    if (isMoved)
      transforms_.push_back({index, worldFromParent, shapeCount_, 0, false});
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    bool hasAny = joints_.contains(index);
    for (const std::size_t child : node.children)
      hasAny |= visit(child, worldFromNode);
    if (isMoved) {
      transforms_[slot].endShape = shapeCount_;
      transforms_[slot].hasAny = hasAny;
    }
    hasNone_[index] = !hasAny;
    return hasAny;
  }

  void addDisplacers(const Node& shape) {
    for (const std::size_t child : shape.children)
      if (std::holds_alternative<Displacer>(graph_.nodes[child].content)) {
        std::vector<std::size_t>& displacers = targets_.displacers[shapeCount_];
        targets_.ofNode[child].push_back({{shapeCount_, shapeCount_ + 1, displacers.size()}, {}});
        displacers.push_back(child);
      }
    ++shapeCount_;
  }

  const SceneGraph& graph_;
  GltfTargets targets_;
  std::set<std::size_t> moved_, joints_;
  std::vector<Visited> transforms_; ///< moved ones, in document order
  std::vector<bool> hasNone_;       ///< by node: there are no shapes and no joints in its subtree
  std::size_t shapeCount_ = 0, visits_ = 0;
};

} // namespace

GltfTargets gltfTargetsOf(const SceneGraph& graph, const std::vector<GltfChannel>& channels) {
  return TargetFinder(graph, channels).targets();
}

} // namespace imgeo
