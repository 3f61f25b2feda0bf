#pragma once
// What fuzz targets require of the results of readers.

#include "base/vec.h"

#include <cmath>
#include <cstdlib>

namespace imgeo::fuzz {

inline void require(bool condition) {
  if (!condition)
    std::abort();
}

inline bool isFinite(Vec3f p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

} // namespace imgeo::fuzz
