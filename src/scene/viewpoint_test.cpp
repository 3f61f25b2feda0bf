#include "scene/viewpoint.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A point in the viewpoint's coordinates: x to the right, y up, z towards the camera.
Vec3d inCameraSpace(const Viewpoint& viewpoint, Vec3d point) {
  // Rodrigues' rotation by the inverse of the orientation.
  const Vec3d v = point - viewpoint.position, k = viewpoint.orientation.axis;
  const double c = std::cos(-viewpoint.orientation.angle), s = std::sin(-viewpoint.orientation.angle);
  return v * c + cross(k, v) * s + k * (dot(k, v) * (1 - c));
}

TEST(ViewpointFor, ShowsEveryCornerOfABoxAndFillsTheView) {
  for (const Vec3d size : {Vec3d{1, 1, 1}, Vec3d{10, 1, 1}, Vec3d{1, 10, 1}, Vec3d{1, 1, 10}, Vec3d{1e-6, 2e-6, 1e-6},
                           Vec3d{0, 3e5, 1e5}}) {
    Box3d box;
    box.add({7, -3, 2});
    box.add(Vec3d{7, -3, 2} + size);
    const Viewpoint viewpoint = viewpointFor(box);
    double maxTangent = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3d point =
          inCameraSpace(viewpoint, {corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                                    corner & 4 ? box.max.z : box.min.z});
      ASSERT_LT(point.z, 0) << "a corner is behind the camera";
      maxTangent = std::max({maxTangent, std::abs(point.x / point.z), std::abs(point.y / point.z)});
    }
    const double viewTangent = std::tan(viewpoint.fieldOfView / 2);
    EXPECT_LT(maxTangent, viewTangent);
    EXPECT_GT(maxTangent, 0.85 * viewTangent);
  }
}

TEST(ViewpointFor, FacesTheCenterOfTheBox) {
  Box3d box;
  box.add({1, 2, 3});
  box.add({2, 5, 4});
  const Viewpoint viewpoint = viewpointFor(box);
  EXPECT_EQ(viewpoint.centerOfRotation, box.center());
  const Vec3d point = inCameraSpace(viewpoint, box.center());
  EXPECT_NEAR(point.x, 0, 1e-9);
  EXPECT_NEAR(point.y, 0, 1e-9);
  EXPECT_LT(point.z, 0);
}

TEST(ViewpointFor, KeepsADistanceFromASinglePoint) {
  Box3d box;
  box.add({1, 2, 3});
  const Viewpoint viewpoint = viewpointFor(box);
  EXPECT_GT(length(viewpoint.position - box.center()), 0);
}

} // namespace
} // namespace imgeo
