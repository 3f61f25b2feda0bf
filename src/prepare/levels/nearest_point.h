#pragma once
// Finds the distance to the nearest point of a set, by a KD tree.

#include "base/vec.h"

#include <cstddef>
#include <vector>

namespace imgeo {

class NearestPoint {
public:
  /// At least one point, of coordinates below 2^24.
  explicit NearestPoint(std::vector<Vec3u> points);

  /// The distance of `point` to the nearest of the points.
  double distanceOf(const Vec3u& point) const;

  /// The larger of `distance` and the distance of `point`, which is searched for no longer than it may be the larger.
  double farther(double distance, const Vec3u& point) const;

private:
  void build(std::size_t begin, std::size_t end);
  /// Makes `square` smaller, until it is at most `enough`.
  void search(std::size_t begin, std::size_t end, const Vec3u& point, double enough, double& square) const;

  std::vector<Vec3u> points_; ///< the middle of each range divides the others along `axes_`
  std::vector<int> axes_;
};

} // namespace imgeo
