#pragma once
// The rotation that maps one set of directions best to another.

#include "base/affine.h"

namespace imgeo {

/// The sum over pairs of b a^T, by columns: to be filled with add().
struct PairSums {
  Affine3d sums{{}, {}, {}, {}};

  void add(Vec3d a, Vec3d b) {
    sums.x += b * a.x;
    sums.y += b * a.y;
    sums.z += b * a.z;
  }
};

/// The proper rotation R that minimises the sum of |R a - b|^2 over all pairs, by the largest eigenvector of a 4 x 4
/// matrix (Horn 1987, "Closed-form solution of absolute orientation using unit quaternions"). Pairs on one line leave
/// the rotation about it open; it is one of those then.
Affine3d bestRotation(const PairSums& pairs);

} // namespace imgeo
