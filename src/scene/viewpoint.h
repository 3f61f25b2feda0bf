#pragma once
// X3D's viewpoints (ISO/IEC 19775-1, 23), with X3D's defaults, and a default viewpoint for a bounding box.

#include "scene/transform.h"

#include <span>
#include <string>

namespace imgeo {

/// X3D Viewpoint: looks along -z of `orientation`.
struct Viewpoint {
  std::string description;
  Vec3d position{0, 0, 10};
  Rotation orientation;
  double fieldOfView = 0.7854; ///< radians, along the shorter side
  Vec3d centerOfRotation;
  friend bool operator==(const Viewpoint&, const Viewpoint&) = default;
};

/// X3D OrthoViewpoint: a viewpoint with a parallel projection.
struct OrthoViewpoint {
  std::string description;
  Vec3d position{0, 0, 10};
  Rotation orientation;
  Vec2<double> min{-1, -1}, max{1, 1}; ///< the visible rectangle, in scene units
  Vec3d centerOfRotation;
  friend bool operator==(const OrthoViewpoint&, const OrthoViewpoint&) = default;
};

/// A viewpoint in the direction `towardsViewer` (of unit length) from the centre of `box`, which it looks at, upright.
/// All points of `outline` are visible from it, with a margin of a tenth of the picture; without points, the whole box
/// is. Seen from above, -z is at the top; seen from below, +z.
Viewpoint viewpointFrom(Vec3d towardsViewer, const Box3d& box, std::span<const Vec3d> outline = {});

} // namespace imgeo
