#pragma once
// Positions of text, which has more digits than single precision.

#include "base/vec.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace imgeo {

/// Rounds positions to single precision, and keeps by how much.
class RoundedPositions {
public:
  /// `position`: may be not finite, and is not counted then.
  Vec3f round(const Vec3d& position) {
    const Vec3f rounded(position);
    if (std::isfinite(rounded.x) && std::isfinite(rounded.y) && std::isfinite(rounded.z)) {
      box_.add(position);
      for (int axis = 0; axis < 3; ++axis)
        maxRounding_ = std::max(maxRounding_, std::abs(position[axis] - static_cast<double>(rounded[axis])));
    }
    return rounded;
  }
  void addWarning(std::vector<std::string>& warnings) const;

private:
  Box3d box_;
  double maxRounding_ = 0;
};

} // namespace imgeo
