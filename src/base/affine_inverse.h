#pragma once
// The inverse of an affine map.

#include "base/affine.h"

namespace imgeo {

/// The inverse map; the determinant must not be 0.
inline Affine3d inverseOf(const Affine3d& map) {
  const Vec3d a = cross(map.y, map.z), b = cross(map.z, map.x), c = cross(map.x, map.y);
  const double scale = 1 / map.determinant();
  Affine3d inverse{Vec3d{a.x, b.x, c.x} * scale, Vec3d{a.y, b.y, c.y} * scale, Vec3d{a.z, b.z, c.z} * scale, {}};
  inverse.translation = inverse.direction(map.translation) * -1;
  return inverse;
}

} // namespace imgeo
