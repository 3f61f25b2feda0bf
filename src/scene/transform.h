#pragma once
// X3D's Transform (ISO/IEC 19775-1, 10.4.4) and its conversion to and from affine maps.

#include "base/affine.h"

#include <array>

namespace imgeo {

/// A rotation about `axis` (of any length) by `angle` radians.
struct Rotation {
  Vec3d axis{0, 0, 1};
  double angle = 0;
  friend bool operator==(const Rotation&, const Rotation&) = default;
};

/// Maps p to translation + center + R SR S SR^-1 (p - center), where R, S and SR are rotation, scale and
/// scaleOrientation.
struct Transform {
  Vec3d translation;
  Rotation rotation;
  Vec3d scale{1, 1, 1};
  Rotation scaleOrientation; ///< orientation of the axes along which `scale` scales
  Vec3d center;
  bool isJoint = false; ///< an HAnimJoint, which moves vertices of a Humanoid's shapes
  friend bool operator==(const Transform&, const Transform&) = default;
};

/// The rotation of the quaternion x i + y j + z k + w, of any length; none for a quaternion of length 0.
Rotation rotationOfQuaternion(double x, double y, double z, double w);

/// The unit quaternion x, y, z, w of a rotation.
std::array<double, 4> quaternionOf(const Rotation& rotation);

Affine3d affineOf(const Rotation& rotation);
Affine3d affineOf(const Transform& transform);

/// The Transform of any affine map, including sheared and mirrored ones, by polar decomposition into a rotation and a
/// stretch along three axes (Shoemake & Duff, "Matrix animation and polar decomposition", 1992).
Transform transformOf(const Affine3d& map);

} // namespace imgeo
