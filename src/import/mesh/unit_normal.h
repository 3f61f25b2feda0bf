#pragma once
// Normalising normals.

#include "base/vec.h"

#include <cmath>

namespace imgeo {

/// Scales a normal to unit length; keeps its bits where its length is within 1e-6 of 1. A normal without a direction
/// (zero or not finite) becomes (0, 0, 1), and the result is false.
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
