#include "scene/scene.h"

#include <cmath>

namespace imgeo {

Viewpoint viewpointFor(const Box3d& box) {
  // The box's bounding sphere fits the shorter side of the view with a small margin.
  Viewpoint viewpoint;
  viewpoint.description = "Start";
  const double radius = std::max(length(box.size()) * 0.5, 1e-9);
  const double distance = 1.05 * radius / std::sin(viewpoint.fieldOfView * 0.5);

  // Turn the default view (along -z) by `yaw` to the side, then look down by `pitch`.
  const double yaw = 0.45, pitch = -0.3;
  const double cy = std::cos(yaw / 2), sy = std::sin(yaw / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
  const Vec3d axis{cy * sp, sy * cp, -sy * sp}; // quaternion yaw * pitch
  const double w = cy * cp;
  const double axisLength = length(axis);
  viewpoint.orientationAxis = axis * (1 / axisLength);
  viewpoint.orientationAngle = 2 * std::atan2(axisLength, w);

  const Vec3d back{std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  viewpoint.centerOfRotation = box.center();
  viewpoint.position = box.center() + back * distance;
  return viewpoint;
}

} // namespace imgeo
