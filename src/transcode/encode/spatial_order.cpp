#include "transcode/encode/spatial_order.h"

#include "prepare/lattice.h"
#include "prepare/primitives.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace imgeo {

namespace {

/// Of each node's content, where the node first stands.
std::vector<Affine3d> worldFromNodes(const SceneGraph& graph) {
  std::vector<Affine3d> worldFromNode(graph.nodes.size());
  std::vector<bool> isKnown(graph.nodes.size());
  for (const std::size_t node : nodesInOrder(graph)) { // parents before children
    if (const Transform* transform = std::get_if<Transform>(&graph.nodes[node].content))
      worldFromNode[node] = worldFromNode[node] * affineOf(*transform);
    for (const std::size_t child : graph.nodes[node].children)
      if (!isKnown[child]) {
        isKnown[child] = true;
        worldFromNode[child] = worldFromNode[node];
      }
  }
  return worldFromNode;
}

/// Transforms of strangers may lead beyond all numbers.
bool isOnEarth(Vec3d place) {
  constexpr double farthest = 1e30;
  return std::abs(place.x) < farthest && std::abs(place.y) < farthest && std::abs(place.z) < farthest;
}

} // namespace

std::vector<std::size_t> spatialOrder(const SceneGraph& graph, const std::vector<Box3d>& boxes) {
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  const std::vector<Affine3d> worldFromNode = worldFromNodes(graph);
  std::vector<Vec3f> middles;
  Box3d box;
  for (const std::size_t shape : shapes) {
    const Vec3d middle = worldFromNode[shape].point(boxes[shapeOf(graph, shape).mesh].center());
    middles.push_back(isOnEarth(middle) ? Vec3f(middle) : Vec3f{});
    box.add(Vec3d(middles.back()));
  }
  const std::vector<Vec3u> places = quantise(middles, latticeFor(box, 16));
  std::vector<std::pair<Vec3u, std::size_t>> order;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    order.push_back({places[i], shapes[i]});
  std::ranges::stable_sort(order, beforeInMortonOrder, &std::pair<Vec3u, std::size_t>::first);
  std::vector<std::size_t> sorted;
  for (const auto& [place, shape] : order)
    sorted.push_back(shape);
  return sorted;
}

} // namespace imgeo
