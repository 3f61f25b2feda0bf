#pragma once
// The normals of files, which are not always of unit length.

#include "base/vec.h"

#include <cmath>

namespace imgeo {

/// Brings a normal to unit length and keeps its bits where it is within 1e-6 of
/// it. One without a direction (zero or not finite) becomes (0, 0, 1), as where
/// normals are computed; returns false then.
inline bool makeUnit(Vec3f& normal) {
  const Vec3d wide(normal);
  const double size = length(wide);
  if (std::abs(size - 1) < 1e-6)
    return true;
  const bool usable = size > 0 && std::isfinite(size);
  normal = usable ? Vec3f(wide * (1 / size)) : Vec3f{0, 0, 1};
  return usable;
}

} // namespace imgeo
