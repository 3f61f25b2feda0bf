#include "scene/transform.h"

#include "scene/testing.h"

#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

using testing::Random;

void expectNear(const Affine3d& a, const Affine3d& b, double tolerance) {
  EXPECT_LE(length(a.x - b.x), tolerance);
  EXPECT_LE(length(a.y - b.y), tolerance);
  EXPECT_LE(length(a.z - b.z), tolerance);
  EXPECT_LE(length(a.translation - b.translation), tolerance);
}

Vec3d randomVector(Random& random) {
  return Vec3d(random.point()) * 3;
}

Affine3d randomMap(Random& random) {
  return {randomVector(random), randomVector(random), randomVector(random), randomVector(random)};
}

TEST(Transform, IsAppliedInTheOrderOfX3d) {
  Transform transform;
  transform.rotation = {{0, 0, 2}, std::numbers::pi / 2};
  transform.scale = {2, 1, 1};
  transform.center = {1, 0, 0};
  transform.translation = {0, 0, 5};
  // (3, 0, 0) is at distance 2 from the centre, 4 after scaling, and is then rotated above the centre.
  EXPECT_LE(length(affineOf(transform).point({3, 0, 0}) - Vec3d{1, 4, 5}), 1e-12);
}

TEST(Transform, RepresentsAnyAffineMap) {
  Random random(5);
  for (int i = 0; i < 500; ++i) {
    SCOPED_TRACE(i);
    const Affine3d map = randomMap(random);
    expectNear(affineOf(transformOf(map)), map, 1e-9);
  }
}

TEST(Transform, HasNoScaleOrientationForARotationAndAScale) {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Transform transform;
    transform.rotation = {randomVector(random), random.between(-3, 3)};
    transform.scale = {random.between(0.1f, 5), random.between(0.1f, 5), random.between(0.1f, 5)};
    if (random.oneIn(2))
      transform.scale = transform.scale * -1;
    const Transform read = transformOf(affineOf(transform));
    EXPECT_EQ(read.scaleOrientation, Rotation{});
    expectNear(affineOf(read), affineOf(transform), 1e-12);
  }
}

TEST(Transform, IsTheDefaultForTheIdentity) {
  EXPECT_EQ(transformOf({}), Transform{});
}

TEST(Transform, MayBeSingular) {
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Affine3d map = randomMap(random);
    const std::uint32_t kind = random.below(5);
    if (kind == 0)
      map.z = map.x + map.y; // flat
    if (kind == 1)
      map.y = map.z = map.x; // a line
    if (kind == 2)
      map.x = map.y = map.z = {};
    if (kind == 3)
      map = {{2, 0, 0}, {}, {0, 0, -1}, {1, 2, 3}};
    if (kind == 4)
      map = {{}, {}, {0, 3, 0}, {}};
    expectNear(affineOf(transformOf(map)), map, 1e-6);
  }
}

TEST(NormalMap, KeepsNormalsPerpendicularToTheirSurface) {
  Random random(8);
  for (int i = 0; i < 200; ++i) {
    const Affine3d map = randomMap(random);
    const Vec3d a = randomVector(random), b = randomVector(random);
    const Vec3d normal = normalMatrixOf(map).direction(cross(a, b));
    EXPECT_NEAR(dot(normal, map.direction(a)), 0, 1e-9);
    EXPECT_NEAR(dot(normal, map.direction(b)), 0, 1e-9);
    // The normal stays on the same side of the surface, even under reflections.
    const Vec3d side = randomVector(random);
    EXPECT_GT(dot(normal, map.direction(side)) * dot(cross(a, b), side), 0);
  }
}

} // namespace
} // namespace imgeo
