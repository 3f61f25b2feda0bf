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

const Vec3d threeQuarters{0.6, 0.48, 0.64};

TEST(ViewpointFrom, ShowsEveryCornerOfABoxAndFillsTheView) {
  for (const Vec3d size : {Vec3d{1, 1, 1}, Vec3d{10, 1, 1}, Vec3d{1, 10, 1}, Vec3d{1, 1, 10}, Vec3d{1e-6, 2e-6, 1e-6},
                           Vec3d{0, 3e5, 1e5}}) {
    Box3d box;
    box.add({7, -3, 2});
    box.add(Vec3d{7, -3, 2} + size);
    const Viewpoint viewpoint = viewpointFrom(threeQuarters, box);
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

TEST(ViewpointFrom, FacesTheCenterOfTheBox) {
  Box3d box;
  box.add({1, 2, 3});
  box.add({2, 5, 4});
  const Viewpoint viewpoint = viewpointFrom(threeQuarters, box);
  EXPECT_EQ(viewpoint.centerOfRotation, box.center());
  const Vec3d point = inCameraSpace(viewpoint, box.center());
  EXPECT_NEAR(point.x, 0, 1e-9);
  EXPECT_NEAR(point.y, 0, 1e-9);
  EXPECT_LT(point.z, 0);
}

TEST(ViewpointFrom, ShowsAnOutlineFromAllSidesAndFillsTheView) {
  Box3d box;
  box.add({-2, 0, -1});
  box.add({2, 3, 1});
  const std::vector<Vec3d> outline{{-2, 1, 0}, {2, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 3, 0}};
  for (const Vec3d direction : {threeQuarters, Vec3d{0, 0, 1}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}}) {
    const Viewpoint viewpoint = viewpointFrom(direction, box, outline);
    double maxTangent = 0;
    for (const Vec3d& outlinePoint : outline) {
      const Vec3d point = inCameraSpace(viewpoint, outlinePoint);
      ASSERT_LT(point.z, 0);
      maxTangent = std::max({maxTangent, std::abs(point.x / point.z), std::abs(point.y / point.z)});
    }
    EXPECT_NEAR(maxTangent, 0.9 * std::tan(viewpoint.fieldOfView / 2), 1e-9);
  }
}

TEST(ViewpointFrom, IsUpright) {
  Box3d box;
  box.add({-1, -1, -1});
  box.add({1, 1, 1});
  EXPECT_GT(inCameraSpace(viewpointFrom(threeQuarters, box), {0, 1, 0}).y, 0);
  EXPECT_GT(inCameraSpace(viewpointFrom({0, 1, 0}, box), {0, 0, -1}).y, 0.9);
  EXPECT_GT(inCameraSpace(viewpointFrom({0, -1, 0}, box), {0, 0, 1}).y, 0.9);
}

TEST(ViewpointFrom, KeepsADistanceFromASinglePoint) {
  Box3d box;
  box.add({1, 2, 3});
  const Viewpoint viewpoint = viewpointFrom(threeQuarters, box);
  EXPECT_GT(length(viewpoint.position - box.center()), 0);
}

} // namespace
} // namespace imgeo
