#include "scene/viewpoint.h"

#include "base/box_corners.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace imgeo {

Viewpoint viewpointFrom(Vec3d towardsViewer, const Box3d& box, std::span<const Vec3d> outline) {
  const double level = std::hypot(towardsViewer.x, towardsViewer.z);
  const Vec3d right = level > 1e-9 ? Vec3d{towardsViewer.z, 0, -towardsViewer.x} * (1 / level) : Vec3d{1, 0, 0};
  const Vec3d up = cross(towardsViewer, right);
  Viewpoint viewpoint;
  viewpoint.orientation = transformOf({right, up, towardsViewer, {}}).rotation;

  const std::array<Vec3d, 8> corners = cornersOf(box);
  // The minimum distance at which all points are visible, with a margin.
  const double maxTangent = 0.9 * std::tan(viewpoint.fieldOfView / 2);
  double distance = 0;
  for (const Vec3d& point : outline.empty() ? corners : outline) {
    const Vec3d offset = point - box.center();
    const double offAxis = std::max(std::abs(dot(offset, right)), std::abs(dot(offset, up)));
    distance = std::max(distance, dot(offset, towardsViewer) + offAxis / maxTangent);
  }
  if (!(distance > 0))
    distance = 1; // a single point
  viewpoint.centerOfRotation = box.center();
  viewpoint.position = box.center() + towardsViewer * distance;
  return viewpoint;
}

} // namespace imgeo
