#include "scene/viewpoint.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

Viewpoint viewpointFor(const Box3d& box) {
  Viewpoint viewpoint;
  viewpoint.description = "Start";

  // Rotates the default view (along -z) by `yaw` to the side, then by `pitch` downwards.
  const double yaw = 0.45, pitch = -0.3;
  const double cy = std::cos(yaw / 2), sy = std::sin(yaw / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
  const Vec3d axis{cy * sp, sy * cp, -sy * sp}; // quaternion yaw * pitch
  const double axisLength = length(axis);
  viewpoint.orientation = {axis * (1 / axisLength), 2 * std::atan2(axisLength, cy * cp)};

  const Vec3d right{std::cos(yaw), 0, -std::sin(yaw)};
  const Vec3d back{std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  const Vec3d up = cross(back, right);

  // The minimum distance at which all corners of the box are visible, with a margin.
  const double maxTangent = 0.9 * std::tan(viewpoint.fieldOfView / 2);
  const Vec3d half = box.size() * 0.5;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d c{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z};
    const double offAxis = std::max(std::abs(dot(c, right)), std::abs(dot(c, up)));
    distance = std::max(distance, dot(c, back) + offAxis / maxTangent);
  }
  if (distance == 0)
    distance = 1; // a single point
  viewpoint.centerOfRotation = box.center();
  viewpoint.position = box.center() + back * distance;
  return viewpoint;
}

} // namespace imgeo
