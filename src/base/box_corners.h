#pragma once
// The corners of a box.

#include "base/vec.h"

#include <array>

namespace imgeo {

/// Those of an empty box have no meaning.
inline std::array<Vec3d, 8> cornersOf(const Box3d& box) {
  std::array<Vec3d, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
  return corners;
}

} // namespace imgeo
