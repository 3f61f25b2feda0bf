#include "transcode/encode/spatial_order.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace imgeo {
namespace {

Box3d unitBox() {
  Box3d box;
  box.add({0, 0, 0});
  box.add({1, 1, 1});
  return box;
}

/// A node that moves one child.
std::size_t addMoved(SceneGraph& graph, Vec3d translation, std::size_t child) {
  Transform transform;
  transform.translation = translation;
  return addNode(graph, {"", transform, {child}, "", {}});
}

TEST(SpatialOrder, GroupsShapesInBlocksNotInRows) {
  SceneGraph graph;
  constexpr std::size_t side = 8;
  std::vector<std::size_t> shapes;
  for (std::size_t n = 0; n < side * side; ++n) {
    shapes.push_back(addNode(graph, {"", Shape{}, {}, "", {}}));
    const std::size_t inner = addMoved(graph, {0, 10.0 * static_cast<double>(n / side), 0}, shapes.back());
    graph.roots.push_back(addMoved(graph, {10.0 * static_cast<double>(n % side), 0, 0}, inner));
  }
  const std::vector<std::size_t> order = spatialOrder(graph, {unitBox()});
  ASSERT_EQ(order.size(), shapes.size());
  for (std::size_t block = 0; block < 4; ++block) {
    std::size_t lowX = side, highX = 0, lowY = side, highY = 0;
    for (std::size_t i = 16 * block; i < 16 * block + 16; ++i) {
      const auto n = static_cast<std::size_t>(std::ranges::find(shapes, order[i]) - shapes.begin());
      lowX = std::min(lowX, n % side), highX = std::max(highX, n % side);
      lowY = std::min(lowY, n / side), highY = std::max(highY, n / side);
    }
    EXPECT_EQ(highX - lowX, 3u);
    EXPECT_EQ(highY - lowY, 3u);
  }
}

TEST(SpatialOrder, ContainsEachShapeOnceWhateverItsInstancesAndTransforms) {
  SceneGraph graph;
  const std::size_t twice = addNode(graph, {"", Shape{}, {}, "", {}}), far = addNode(graph, {"", Shape{}, {}, "", {}});
  constexpr double infinite = std::numeric_limits<double>::infinity();
  graph.roots = {addMoved(graph, {5, 0, 0}, twice), addMoved(graph, {infinite, 0, 0}, far),
                 addMoved(graph, {7, 0, 0}, twice)};
  std::vector<std::size_t> order = spatialOrder(graph, {unitBox()});
  std::ranges::sort(order);
  EXPECT_EQ(order, (std::vector{twice, far}));
}

} // namespace
} // namespace imgeo
