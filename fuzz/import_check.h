#pragma once
// The check of all fuzz targets of input formats: every input gives an Error with a message, or a scene that keeps the
// promises of import.h. Aborts otherwise.

#include "base/bytes.h"
#include "base/vec.h"

#include <cmath>
#include <cstdlib>
#include <string>

namespace imgeo::fuzz {

inline void require(bool condition) {
  if (!condition)
    std::abort();
}

inline bool isFinite(Vec3f p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Runs the check on an input file `name`. Returns 0, as fuzz targets do.
int importOrRefuse(ByteSpan bytes, const std::string& name);

} // namespace imgeo::fuzz
