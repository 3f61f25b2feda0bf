#pragma once
// Affine maps of space: a 3 x 3 matrix by columns, and a translation.

#include "base/vec.h"

namespace imgeo {

struct Affine3d {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}; ///< images of the unit axes
  Vec3d translation;

  Vec3d direction(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(Vec3d p) const { return direction(p) + translation; }
  double determinant() const { return dot(x, cross(y, z)); }

  /// The composition that applies `b` first.
  friend Affine3d operator*(const Affine3d& a, const Affine3d& b) {
    return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.point(b.translation)};
  }
  friend bool operator==(const Affine3d&, const Affine3d&) = default;
};

/// The matrix that maps the normals of a surface when `a` maps its points. It keeps no lengths: it is the cofactor
/// matrix, which exists for singular matrices too, with the sign of the determinant.
inline Affine3d normalMatrixOf(const Affine3d& a) {
  const double sign = a.determinant() < 0 ? -1 : 1;
  return {cross(a.y, a.z) * sign, cross(a.z, a.x) * sign, cross(a.x, a.y) * sign, {}};
}

} // namespace imgeo
