#pragma once
// Quadric error metrics (Garland and Heckbert, "Surface simplification using quadric error metrics", 1997).

#include "base/vec.h"

namespace imgeo {

/// A weighted sum of squared distances to planes, as a function of position.
class Quadric {
public:
  /// Adds the plane through `point`; `normal` has length 1.
  void addPlane(Vec3d normal, Vec3d point, double weight) {
    const Vec3d n = normal * weight;
    const double distance = -dot(normal, point);
    xx_ += n.x * normal.x, xy_ += n.x * normal.y, xz_ += n.x * normal.z;
    yy_ += n.y * normal.y, yz_ += n.y * normal.z, zz_ += n.z * normal.z;
    linear_ += n * distance;
    constant_ += weight * distance * distance;
    weight_ += weight;
  }
  Quadric& operator+=(const Quadric& other) {
    xx_ += other.xx_, xy_ += other.xy_, xz_ += other.xz_;
    yy_ += other.yy_, yz_ += other.yz_, zz_ += other.zz_;
    linear_ += other.linear_;
    constant_ += other.constant_;
    weight_ += other.weight_;
    return *this;
  }

  /// The sum of the weights of all planes.
  double weight() const { return weight_; }

  /// The weighted sum of squared distances. Rounding may make it negative.
  double errorAt(Vec3d p) const { return dot(p, timesMatrix(p)) + 2 * dot(linear_, p) + constant_; }

  /// The position of minimum error. A term of small weight pulls it towards `near`: of positions with almost equal
  /// errors, as on a plane, it is the one closest to `near`.
  Vec3d minimizerNear(Vec3d near) const {
    const double regularisation = 1e-3 * (xx_ + yy_ + zz_);
    const double a = xx_ + regularisation, d = yy_ + regularisation, f = zz_ + regularisation;
    // The inverse of a symmetric matrix, by its cofactors.
    const double c00 = d * f - yz_ * yz_, c01 = xz_ * yz_ - xy_ * f, c02 = xy_ * yz_ - d * xz_;
    const double c11 = a * f - xz_ * xz_, c12 = xy_ * xz_ - a * yz_, c22 = a * d - xy_ * xy_;
    const double determinant = a * c00 + xy_ * c01 + xz_ * c02;
    if (!(determinant > 0))
      return near;
    const Vec3d slope = (timesMatrix(near) + linear_) * (-1 / determinant);
    return near + Vec3d{c00 * slope.x + c01 * slope.y + c02 * slope.z, c01 * slope.x + c11 * slope.y + c12 * slope.z,
                        c02 * slope.x + c12 * slope.y + c22 * slope.z};
  }

private:
  Vec3d timesMatrix(Vec3d p) const {
    return {xx_ * p.x + xy_ * p.y + xz_ * p.z, xy_ * p.x + yy_ * p.y + yz_ * p.z, xz_ * p.x + yz_ * p.y + zz_ * p.z};
  }

  double xx_ = 0, xy_ = 0, xz_ = 0, yy_ = 0, yz_ = 0, zz_ = 0;
  Vec3d linear_;
  double constant_ = 0, weight_ = 0;
};

} // namespace imgeo
