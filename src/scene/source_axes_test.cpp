#include "scene/source_axes.h"

#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <array>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(SourceAxes, TurnTheStatedDirectionToY) {
  const std::array<Vec3d, 6> directions{Vec3d{1, 0, 0},  Vec3d{0, 1, 0},  Vec3d{0, 0, 1},
                                        Vec3d{-1, 0, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, -1}};
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const Affine3d map = documentFromSource({.up = static_cast<AxisDirection>(i)});
    EXPECT_EQ(map.direction(directions[i]), (Vec3d{0, 1, 0})) << nameOf(static_cast<AxisDirection>(i));
    EXPECT_EQ(map.determinant(), 1);
  }
  EXPECT_EQ(documentFromSource({.up = AxisDirection::z}).direction({0, -1, 0}), (Vec3d{0, 0, 1}));
}

TEST(SourceAxes, RotateInTheirOrderAndThenScale) {
  const Affine3d map = documentFromSource({.rotations = {{0, 90}, {1, 90}}, .scale = 2});
  EXPECT_EQ(map.direction({0, 1, 0}), (Vec3d{2, 0, 0})); // y to z about x, z to x about y
  EXPECT_NEAR(
      length(documentFromSource({.rotations = {{2, 30}}}).direction({1, 0, 0}) - Vec3d{std::sqrt(0.75), 0.5, 0}), 0,
      1e-15);
}

TEST(SourceAxes, AreOneTransformAndCanBeUndone) {
  const SourceAxes axes{.up = AxisDirection::z, .rotations = {{1, 25}, {0, 10}}, .scale = 0.001, .exaggeration = 3};
  Scene scene = testing::sceneOf({testing::sphere(4, 4), testing::sphere(4, 4)});
  applySourceAxes(scene.graph, axes);
  ASSERT_EQ(scene.graph.roots.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<Transform>(scene.graph.nodes[scene.graph.roots[0]].content));
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    EXPECT_NEAR(length(instance.worldFromShape.point({1, 2, 3}) - documentFromSource(axes).point({1, 2, 3})), 0, 1e-12);
  undoSourceAxes(scene.graph, axes);
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    EXPECT_NEAR(length(instance.worldFromShape.point({1, 2, 3}) - Vec3d{1, 2, 3}), 0, 1e-12);
}

TEST(SourceAxes, ChangeNothingByDefault) {
  Scene scene = testing::sceneOf({testing::sphere(4, 4)});
  const SceneGraph before = scene.graph;
  applySourceAxes(scene.graph, {});
  EXPECT_EQ(scene.graph, before);
}

TEST(SourceAxes, LeaveDeclarationsBeforeAndRoutesAfterTheTransform) {
  SceneGraph graph;
  for (const char* element : {"Group", "ROUTE", "ProtoDeclare", "Inline"})
    addRoot(graph, {"", GenericNode{element, "", {}}, {}, ""});
  applySourceAxes(graph, {.up = AxisDirection::z});
  ASSERT_EQ(graph.roots.size(), 3u);
  EXPECT_EQ(std::get<GenericNode>(graph.nodes[graph.roots[0]].content).element, "ProtoDeclare");
  EXPECT_EQ(graph.nodes[graph.roots[1]].children.size(), 2u);
  EXPECT_EQ(std::get<GenericNode>(graph.nodes[graph.roots[2]].content).element, "ROUTE");
}

} // namespace
} // namespace imgeo
