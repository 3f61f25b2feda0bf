#include "transcode/default_scene/start_view.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A rectangle with these two edges. Its front faces cross(right, up).
Mesh plate(Vec3d right, Vec3d up) {
  Mesh mesh;
  mesh.positions = {Vec3f{}, Vec3f(right), Vec3f(right + up), Vec3f(up)};
  mesh.wedgePositions = {0, 1, 2, 3};
  mesh.corners = {0, 1, 2, 0, 2, 3};
  return mesh;
}

Vec3d bestFor(const Scene& scene) {
  return bestDirection(viewSamplesOf(scene).surface);
}

TEST(StartView, ShowsTheBroadSideFromTheFront) {
  const Vec3d direction = bestFor(testing::sceneOf({plate({4, 0, 0}, {0, 1, 0})}));
  EXPECT_GT(direction.z, 0.8);
  EXPECT_GT(direction.y, 0);
}

TEST(StartView, ShowsWhatIsBroadAlongZFromASide) {
  EXPECT_GT(std::abs(bestFor(testing::sceneOf({plate({0, 0, 4}, {0, 1, 0})})).x), 0.8);
}

TEST(StartView, IsFromAboveForATerrain) {
  EXPECT_GT(bestFor(testing::sceneOf({plate({0, 0, 4}, {4, 0, 0})})).y, 0.7);
}

TEST(StartView, ShowsTheFrontOfASurfaceThatIsOpenBehind) {
  Scene scene = testing::sceneOf({plate({0, 4, 0}, {4, 0, 0})}); // its front is at -z
  EXPECT_LT(bestFor(scene).z, -0.5);
}

TEST(StartView, ExistsForPointsLinesAndNothing) {
  for (const Scene& scene :
       {testing::sceneOf({testing::pointCloud(50, 1)}), testing::sceneOf({testing::polylines(5, 1)}),
        testing::sceneOf({testing::pointCloud(1, 1)}), Scene()})
    EXPECT_NEAR(length(bestFor(scene)), 1, 1e-9);
}

TEST(StartView, OutlinesIncludeThinTips) {
  Mesh spike = testing::sphere(20, 20);
  const auto tip = static_cast<std::uint32_t>(spike.positions.size());
  spike.positions.push_back({0, 1e3f, 0});
  spike.wedgePositions.push_back(tip);
  for (const std::uint32_t corner : {0u, 0u, static_cast<std::uint32_t>(spike.wedgePositions.size() - 1)})
    spike.corners.push_back(corner);
  spike.normals.clear();
  const ViewSamples samples = viewSamplesOf(testing::sceneOf({spike}));
  EXPECT_TRUE(std::ranges::find(samples.outline, Vec3d{0, 1e3, 0}) != samples.outline.end());
}

/// A plate of 4 × 1 in a Transform that a clock moves to x = 100 and back.
Scene slidingPlate() {
  Scene scene = testing::sceneOf({plate({4, 0, 0}, {0, 1, 0})});
  SceneGraph& graph = scene.graph;
  const std::size_t moved = addNode(graph, {"slide", Transform{}, graph.roots, ""});
  const std::size_t clock = addNode(graph, {"clock", TimeSensor{}, {}, ""});
  const Interpolator path{InterpolatorKind::position, {0, 0.5f, 1}, {0, 0, 0, 100, 0, 0, 0, 0, 0}};
  const std::size_t interpolator = addNode(graph, {"path", path, {}, ""});
  graph.roots = {moved, clock, interpolator};
  graph.routes = {{clock, "fraction_changed", interpolator, "set_fraction"},
                  {interpolator, "value_changed", moved, "set_translation"}};
  return scene;
}

TEST(StartView, OutlinesIncludeWhatAnimationsMove) {
  const ViewSamples samples = viewSamplesOf(slidingPlate());
  EXPECT_EQ(samples.moving, (Box3d{{0, 0, 0}, {104, 1, 0}}));
  EXPECT_TRUE(std::ranges::find(samples.outline, Vec3d{104, 1, 0}) != samples.outline.end());
}

TEST(StartView, OutlinesOfScenesAtRestHaveNoBoxOfWhatMoves) {
  EXPECT_TRUE(viewSamplesOf(testing::sceneOf({plate({4, 0, 0}, {0, 1, 0})})).moving.empty());
}

} // namespace
} // namespace imgeo
