#include "scene/surface_samples.h"

#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// Two triangles in the plane z = 0, of sizes 1 and 3, and one of no area.
Mesh unequalTriangles() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {10, 0, 0}, {16, 0, 0}, {10, 1, 0}};
  mesh.wedgePositions = {0, 1, 2, 3, 4, 5};
  mesh.corners = {0, 1, 2, 3, 4, 5, 0, 0, 1};
  return mesh;
}

TEST(SurfaceSamples, AreAsManyPerAreaEverywhere) {
  const std::vector<SurfaceSample> samples = surfaceSamples(testing::sceneOf({unequalTriangles()}), 1000);
  EXPECT_NEAR(static_cast<double>(samples.size()), 1000, 2);
  const auto inFirst = std::ranges::count_if(samples, [](const SurfaceSample& sample) { return sample.point.x <= 2; });
  EXPECT_NEAR(static_cast<double>(inFirst), 250, 2);
  for (const SurfaceSample& sample : samples) {
    EXPECT_EQ(sample.normal, (Vec3f{0, 0, 1}));
    const double x = sample.point.x <= 2 ? sample.point.x / 2 : (sample.point.x - 10) / 6;
    EXPECT_TRUE(x >= 0 && sample.point.y >= 0 && x + sample.point.y <= 1 + 1e-9);
  }
}

TEST(SurfaceSamples, AreInWorldCoordinatesAndFollowTheScaleOfInstances) {
  Scene scene = testing::sceneOf({unequalTriangles()});
  const std::size_t shape = shapeNodes(scene.graph)[0];
  Transform large;
  large.translation = {100, 0, 0};
  large.scale = {3, 3, 3};
  scene.graph.roots = {shape, addNode(scene.graph, {"", large, {shape}, ""})};
  const std::vector<SurfaceSample> samples = surfaceSamples(scene, 1000);
  const auto inLarge =
      std::ranges::count_if(samples, [](const SurfaceSample& sample) { return sample.point.x >= 100; });
  EXPECT_NEAR(static_cast<double>(inLarge), 900, 5);
}

TEST(SurfaceSamples, KeepTheFrontOfMirroredShapes) {
  Scene scene = testing::sceneOf({unequalTriangles()});
  Transform mirror;
  mirror.scale = {-1, 1, 1};
  scene.graph.roots = {addNode(scene.graph, {"", mirror, scene.graph.roots, ""})};
  for (const SurfaceSample& sample : surfaceSamples(scene, 100))
    EXPECT_EQ(sample.normal, (Vec3f{0, 0, 1}));
}

TEST(SurfaceSamples, AreLinesOrPointsWhereThereAreNoTriangles) {
  const std::vector<SurfaceSample> points = surfaceSamples(testing::sceneOf({testing::pointCloud(500, 1)}), 1000);
  EXPECT_EQ(points.size(), 500u);
  EXPECT_EQ(points[0].normal, Vec3f{});
  EXPECT_NEAR(static_cast<double>(surfaceSamples(testing::sceneOf({testing::polylines(30, 1)}), 200).size()), 200, 2);
  EXPECT_TRUE(surfaceSamples({}, 100).empty());
}

TEST(SurfaceSamples, LeaveOutShapesThatCannotBeDrawn) {
  Scene scene = testing::sceneOf({unequalTriangles()});
  Transform huge;
  huge.scale = {1e20, 1e20, 1e20};
  scene.graph.roots.push_back(addNode(scene.graph, {"", huge, scene.graph.roots, ""}));
  for (const SurfaceSample& sample : surfaceSamples(scene, 100))
    EXPECT_LE(sample.point.x, 16);
}

} // namespace
} // namespace imgeo
