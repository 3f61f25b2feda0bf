#include "scene/shape_instances.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

std::size_t addTransform(SceneGraph& graph, Vec3d translation, std::vector<std::size_t> children) {
  Transform transform;
  transform.translation = translation;
  return addNode(graph, {"", transform, std::move(children), ""});
}

TEST(ShapeInstances, HaveTheTransformsOfTheirParents) {
  SceneGraph graph;
  const std::size_t shape = addNode(graph, {"seat", Shape{}, {}, ""});
  const std::size_t row = addNode(
      graph, {"row", Group{}, {addTransform(graph, {1, 0, 0}, {shape}), addTransform(graph, {2, 0, 0}, {shape})}, ""});
  graph.roots = {addTransform(graph, {0, 10, 0}, {row}), addTransform(graph, {0, 20, 0}, {row}), shape};
  std::vector<Vec3d> positions;
  for (const ShapeInstance& instance : shapeInstances(graph)) {
    EXPECT_EQ(instance.node, shape);
    positions.push_back(instance.worldFromShape.point({0, 0, 0}));
  }
  EXPECT_EQ(positions, (std::vector<Vec3d>{{1, 10, 0}, {2, 10, 0}, {1, 20, 0}, {2, 20, 0}, {0, 0, 0}}));
  EXPECT_EQ(shapeNodes(graph), std::vector<std::size_t>{shape});
  EXPECT_EQ(nodesInOrder(graph).size(), graph.nodes.size());
}

TEST(ShapeInstances, AreRefusedWhereNestedGroupsMultiplyThem) {
  SceneGraph graph;
  std::size_t node = addNode(graph, {"", Shape{}, {}, ""});
  for (int level = 0; level < 60; ++level)
    node = addNode(graph, {"", Group{}, {node, node}, ""});
  graph.roots = {node};
  EXPECT_THROW(shapeInstances(graph), Error);
}

TEST(ShapeInstances, AreFoundQuicklyBesideNestedGroupsWithoutShapes) {
  SceneGraph graph;
  std::size_t node = addNode(graph, {"", Group{}, {}, ""});
  for (int level = 0; level < 60; ++level)
    node = addNode(graph, {"", Group{}, {node, node}, ""});
  graph.roots = {node, addNode(graph, {"", Shape{}, {}, ""})};
  EXPECT_EQ(shapeInstances(graph).size(), 1u);
}

} // namespace
} // namespace imgeo
