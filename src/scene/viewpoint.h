#pragma once
// X3D's viewpoints (ISO/IEC 19775-1, 23), with X3D's defaults, and a default viewpoint for a bounding box.

#include "scene/transform.h"

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

/// A default viewpoint from which a whole box is visible: centred on the box, slightly above and to the side.
Viewpoint viewpointFor(const Box3d& box);

} // namespace imgeo
