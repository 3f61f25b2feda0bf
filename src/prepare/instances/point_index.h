#pragma once
// Finds the point of a set that is nearest to another, within a small distance.

#include "base/vec.h"

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace imgeo {

/// Points by the cells of a grid.
class PointIndex {
public:
  /// `points` has to outlive this. `within`: the largest distance that nearest() looks at, positive.
  PointIndex(std::span<const Vec3f> points, double within);

  struct Found {
    std::uint32_t index = 0;
    double distance = 0;
  };
  /// The nearest point, of equally near ones that with the lowest index; nothing if none is within the distance.
  std::optional<Found> nearest(const Vec3d& at) const;

private:
  Vec3<std::int64_t> cellOf(const Vec3d& at) const;

  std::span<const Vec3f> points_;
  double within_, cellSize_;
  Vec3d origin_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_; ///< by hash of a cell: its first point
  std::vector<std::uint32_t> next_;                        ///< the next point of a cell, ascending
};

} // namespace imgeo
