#include "scene/viewpoint.h"

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

} // namespace
} // namespace imgeo
