#pragma once
// Positions of text, which has more digits than single precision.

#include "base/vec.h"
#include "import/mesh/far_origin.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// Rounds positions, less an origin, to single precision, and keeps by how much.
class RoundedPositions {
public:
  /// `origin`: by default farOriginOf() the first position.
  explicit RoundedPositions(const std::optional<Vec3d>& origin) : origin_(origin) {}

  /// `stated`: may be not finite, and is not counted then.
  Vec3f round(const Vec3d& stated) {
    if (!origin_)
      origin_ = farOriginOf(stated);
    const Vec3d position = stated - *origin_;
    const Vec3f rounded(position);
    if (std::isfinite(rounded.x) && std::isfinite(rounded.y) && std::isfinite(rounded.z)) {
      box_.add(position);
      for (int axis = 0; axis < 3; ++axis)
        maxRounding_ = std::max(maxRounding_, std::abs(position[axis] - static_cast<double>(rounded[axis])));
    }
    return rounded;
  }
  /// What is subtracted; 0 before the first position.
  Vec3d origin() const { return origin_.value_or(Vec3d{0, 0, 0}); }
  void addWarning(std::vector<std::string>& warnings) const;

private:
  std::optional<Vec3d> origin_;
  Box3d box_;
  double maxRounding_ = 0;
};

} // namespace imgeo
