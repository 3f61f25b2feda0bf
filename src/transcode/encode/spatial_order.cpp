#include "transcode/encode/spatial_order.h"

#include "prepare/lattice.h"
#include "prepare/primitives.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace imgeo {

namespace {

/// Whether a position fits single precision. Untrusted transforms may lead to infinity.
bool isRepresentable(Vec3d position) {
  constexpr double max = 1e30;
  return std::abs(position.x) < max && std::abs(position.y) < max && std::abs(position.z) < max;
}

} // namespace

std::vector<std::size_t> spatialOrder(const SceneGraph& graph, const std::vector<Box3d>& boxes) {
  const std::vector<std::size_t> shapes = shapeNodes(graph);
  const std::vector<Affine3d> worldFromNode = worldFromNodes(graph);
  std::vector<Vec3f> centers;
  Box3d box;
  for (const std::size_t shape : shapes) {
    const Vec3d center = worldFromNode[shape].point(boxes[shapeOf(graph, shape).mesh].center());
    centers.push_back(isRepresentable(center) ? Vec3f(center) : Vec3f{});
    box.add(Vec3d(centers.back()));
  }
  const std::vector<Vec3u> latticePoints = quantise(centers, latticeFor(box, 16));
  std::vector<std::pair<Vec3u, std::size_t>> order;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    order.push_back({latticePoints[i], shapes[i]});
  std::ranges::stable_sort(order, isBeforeInMortonOrder, &std::pair<Vec3u, std::size_t>::first);
  std::vector<std::size_t> sorted;
  sorted.reserve(order.size());
  for (const auto& [point, shape] : order)
    sorted.push_back(shape);
  return sorted;
}

} // namespace imgeo
