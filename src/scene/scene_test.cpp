#include "scene/scene.h"

#include "base/error.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A point as the viewpoint sees it: to the right, up, and towards the eye.
Vec3d seenFrom(const Viewpoint& viewpoint, Vec3d point) {
  // Rodrigues' rotation by the inverse of the orientation.
  const Vec3d v = point - viewpoint.position, k = viewpoint.orientation.axis;
  const double c = std::cos(-viewpoint.orientation.angle), s = std::sin(-viewpoint.orientation.angle);
  return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c));
}

TEST(ViewpointFor, SeesEveryCornerOfABoxAndFillsTheViewWithIt) {
  for (const Vec3d size : {Vec3d{1, 1, 1}, Vec3d{10, 1, 1}, Vec3d{1, 10, 1}, Vec3d{1, 1, 10}, Vec3d{1e-6, 2e-6, 1e-6},
                           Vec3d{0, 3e5, 1e5}}) {
    Box3d box;
    box.add({7, -3, 2});
    box.add(Vec3d{7, -3, 2} + size);
    const Viewpoint viewpoint = viewpointFor(box);
    double widest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d seen = seenFrom(viewpoint, {corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                              corner & 4 ? box.max.z : box.min.z});
      ASSERT_LT(seen.z, 0) << "a corner lies behind the eye";
      widest = std::max({widest, std::abs(seen.x / seen.z), std::abs(seen.y / seen.z)});
    }
    const double edge = std::tan(viewpoint.fieldOfView / 2);
    EXPECT_LT(widest, edge);
    EXPECT_GT(widest, 0.85 * edge);
  }
}

TEST(ViewpointFor, LooksAtTheMiddleOfTheBox) {
  Box3d box;
  box.add({1, 2, 3});
  box.add({2, 5, 4});
  const Viewpoint viewpoint = viewpointFor(box);
  EXPECT_EQ(viewpoint.centerOfRotation, box.center());
  const Vec3d seen = seenFrom(viewpoint, box.center());
  EXPECT_NEAR(seen.x, 0, 1e-9);
  EXPECT_NEAR(seen.y, 0, 1e-9);
  EXPECT_LT(seen.z, 0);
}

TEST(ViewpointFor, StandsOffASinglePoint) {
  Box3d box;
  box.add({1, 2, 3});
  const Viewpoint viewpoint = viewpointFor(box);
  EXPECT_GT(length(viewpoint.position - box.center()), 0);
}

std::size_t addTransform(SceneGraph& graph, Vec3d translation, std::vector<std::size_t> children) {
  Transform transform;
  transform.translation = translation;
  return addNode(graph, {"", transform, std::move(children), ""});
}

TEST(PlacedShapes, StandWhereTheirParentsPutThem) {
  SceneGraph graph;
  const std::size_t shape = addNode(graph, {"seat", Shape{}, {}, ""});
  const std::size_t row = addNode(
      graph, {"row", Group{}, {addTransform(graph, {1, 0, 0}, {shape}), addTransform(graph, {2, 0, 0}, {shape})}, ""});
  graph.roots = {addTransform(graph, {0, 10, 0}, {row}), addTransform(graph, {0, 20, 0}, {row}), shape};
  std::vector<Vec3d> places;
  for (const PlacedShape& placed : placedShapes(graph)) {
    EXPECT_EQ(placed.node, shape);
    places.push_back(placed.worldFromShape.point({0, 0, 0}));
  }
  EXPECT_EQ(places, (std::vector<Vec3d>{{1, 10, 0}, {2, 10, 0}, {1, 20, 0}, {2, 20, 0}, {0, 0, 0}}));
  EXPECT_EQ(shapeNodes(graph), std::vector<std::size_t>{shape});
  EXPECT_EQ(nodesInOrder(graph).size(), graph.nodes.size());
}

TEST(PlacedShapes, AreRefusedWhereGroupsOfGroupsGrowWithoutMeasure) {
  SceneGraph graph;
  std::size_t node = addNode(graph, {"", Shape{}, {}, ""});
  for (int level = 0; level < 60; ++level)
    node = addNode(graph, {"", Group{}, {node, node}, ""});
  graph.roots = {node};
  EXPECT_THROW(placedShapes(graph), Error);
}

TEST(PlacedShapes, AreFoundQuicklyBesideGroupsThatHoldNone) {
  SceneGraph graph;
  std::size_t node = addNode(graph, {"", Group{}, {}, ""});
  for (int level = 0; level < 60; ++level)
    node = addNode(graph, {"", Group{}, {node, node}, ""});
  graph.roots = {node, addNode(graph, {"", Shape{}, {}, ""})};
  EXPECT_EQ(placedShapes(graph).size(), 1u);
}

TEST(RemoveShapes, LeavesTheNodesAroundThem) {
  SceneGraph graph;
  const std::size_t kept = addRoot(graph, {"", Shape{1, {}, true}, {}, ""});
  const std::size_t gone = addRoot(graph, {"", Shape{0, {}, true}, {}, ""});
  const std::size_t group = addRoot(graph, {"", Group{}, {gone, kept, gone}, ""});
  removeShapes(graph, {true, false});
  EXPECT_EQ(graph.roots, (std::vector<std::size_t>{kept, group}));
  EXPECT_EQ(graph.nodes[group].children, std::vector<std::size_t>{kept});
}

TEST(PhongOf, KeepsMaterialsOfItsKindAndShowsOthers) {
  const Material material{.diffuseColor{1, 0, 0}, .transparency = 0.5f};
  EXPECT_EQ(phongOf(material), material);
  const Material plaster = phongOf(PhysicalMaterial{.baseColor{1, 1, 1}, .metallic = 0, .roughness = 1});
  EXPECT_NEAR(plaster.diffuseColor.x, 1, 1e-6);
  EXPECT_EQ(plaster.specularColor, (Vec3f{0, 0, 0}));
  const Material mirror = phongOf(PhysicalMaterial{.baseColor{1, 0, 0}, .metallic = 1, .roughness = 0});
  EXPECT_NEAR(mirror.specularColor.x, 1, 1e-6);
  EXPECT_NEAR(mirror.specularColor.y, 0, 1e-6);
  EXPECT_GT(mirror.diffuseColor.x, 0.5f);
  EXPECT_EQ(phongOf(UnlitMaterial{.emissiveColor{0, 1, 0}}).emissiveColor, (Vec3f{0, 1, 0}));
}

} // namespace
} // namespace imgeo
