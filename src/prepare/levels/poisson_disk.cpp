#include "prepare/levels/poisson_disk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint32_t noPoint = 0xffffffff;

/// Bits without pattern for a position or a grid cell (the finaliser of SplitMix64).
std::uint64_t mixedBits(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  std::uint64_t hash = x * 0x9e3779b97f4a7c15 ^ y * 0xc2b2ae3d27d4eb4f ^ z * 0x165667b19e3779f9;
  hash = (hash ^ hash >> 30) * 0xbf58476d1ce4e5b9;
  hash = (hash ^ hash >> 27) * 0x94d049bb133111eb;
  return hash ^ hash >> 31;
}

/// The order in which points are chosen. It is the same on all levels, so that points of coarse levels are likely to
/// be chosen again.
std::vector<std::uint32_t> orderOf(std::span<const Vec3u> points) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
    keys[i] = {mixedBits(points[i].x, points[i].y, points[i].z), i};
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order(points.size());
  std::ranges::transform(keys, order.begin(), &std::pair<std::uint64_t, std::uint32_t>::second);
  return order;
}

double squaredSteps(const Vec3u& a, const Vec3u& b) {
  const Vec3d difference = Vec3d(a) - Vec3d(b);
  return dot(difference, difference); // exact: below 2^50
}

/// Points in a grid whose cells are two radii wide, so that all within a radius of a point are in eight cells.
class DiskGrid {
public:
  DiskGrid(std::span<const Vec3u> points, double radius)
      : points_(points), radius_(radius), heads_(std::bit_ceil(points.size() / 2 + 16), noPoint), next_(points.size()) {
  }

  void add(std::uint32_t point) {
    const std::array<double, 3> at = cellOf(point);
    std::uint32_t& head = heads_[bucketOf(std::floor(at[0]), std::floor(at[1]), std::floor(at[2]))];
    next_[point] = std::exchange(head, point);
  }

  /// Whether isNear(other, squared distance) is true of a point of the grid. It is called for all within a radius, and
  /// for others.
  template <typename IsNear> bool findNear(std::uint32_t point, IsNear isNear) const {
    const std::array<double, 3> at = cellOf(point);
    std::array<std::array<double, 2>, 3> cells;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double cell = std::floor(at[axis]);
      cells[axis] = {cell, at[axis] - cell < 0.5 ? cell - 1 : cell + 1};
    }
    for (const double x : cells[0])
      for (const double y : cells[1])
        for (const double z : cells[2])
          for (std::uint32_t other = heads_[bucketOf(x, y, z)]; other != noPoint; other = next_[other])
            if (isNear(other, squaredSteps(points_[point], points_[other])))
              return true;
    return false;
  }

private:
  std::array<double, 3> cellOf(std::uint32_t point) const {
    const double edge = 2 * radius_;
    return {points_[point].x / edge, points_[point].y / edge, points_[point].z / edge};
  }
  /// Cells may share a bucket: distances are compared anyway.
  std::size_t bucketOf(double x, double y, double z) const {
    const auto part = [](double cell) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(cell)); };
    return mixedBits(part(x), part(y), part(z)) & (heads_.size() - 1);
  }

  std::span<const Vec3u> points_;
  double radius_;
  std::vector<std::uint32_t> heads_, next_; ///< lists of points, by bucket
};

/// Points that are divided into parts, in the order in which they are chosen.
struct DartBoard {
  std::span<const Vec3u> points;
  std::span<const std::uint32_t> parts; ///< by point
  std::vector<std::uint32_t> order;
};

/// The points that darts of a radius choose: first those that are near no other, and then those that are near none of
/// their own part, at the borders of parts.
std::vector<bool> throwDarts(const DartBoard& board, double radius) {
  const double square = radius * radius;
  DiskGrid grid(board.points, radius);
  std::vector<bool> isKept(board.points.size());
  for (const std::uint32_t point : board.order)
    if (!grid.findNear(point, [&](std::uint32_t, double distance) { return distance < square; })) {
      grid.add(point);
      isKept[point] = true;
    }
  const auto isNear = [&](std::uint32_t point, std::uint32_t other, double distance) {
    return distance < square && board.parts[point] == board.parts[other];
  };
  for (const std::uint32_t point : board.order)
    if (!isKept[point] &&
        !grid.findNear(point, [&](std::uint32_t other, double distance) { return isNear(point, other, distance); })) {
      grid.add(point);
      isKept[point] = true;
    }
  return isKept;
}

/// Half a step: points at the same position exclude one another, and no others.
constexpr double minRadius = 0.5;

/// The radius to begin with: that of a flat cloud over the two longest edges of the box.
double firstRadius(std::span<const Vec3u> points, std::size_t maxKept) {
  Box3d box;
  for (const Vec3u& point : points)
    box.add(Vec3d(point));
  std::array<double, 3> edges{box.size().x, box.size().y, box.size().z};
  std::ranges::sort(edges);
  return std::max(1.0, std::sqrt(std::max(edges[1], 1.0) * edges[2] / static_cast<double>(maxKept)));
}

/// A radius whose darts choose at most `maxKept` points, and few less. Halves the range between a radius that chooses
/// too many and one that does not, at the place where a surface would choose the number that is sought.
double radiusFor(const DartBoard& board, std::size_t maxKept) {
  constexpr int maxTries = 24;
  constexpr double enough = 0.9, precision = 1.002;
  const double goal = 0.95 * static_cast<double>(maxKept);
  double tooSmall = 0, radius = firstRadius(board.points, maxKept), best = std::numeric_limits<double>::infinity();
  for (int n = 0; n < maxTries || std::isinf(best); ++n) {
    const auto count = static_cast<double>(std::ranges::count(throwDarts(board, radius), true));
    if (count > static_cast<double>(maxKept))
      tooSmall = radius;
    else
      best = radius;
    if (best == radius && (count >= enough * static_cast<double>(maxKept) || radius == minRadius))
      break;
    if (tooSmall > 0 && best <= precision * tooSmall)
      break;
    radius *= std::sqrt(count / goal);
    const bool isOutside = radius <= tooSmall || radius >= best;
    if (isOutside)
      radius = tooSmall == 0 ? best / 2 : std::isinf(best) ? 2 * tooSmall : std::sqrt(tooSmall * best);
    radius = std::max(radius, minRadius);
  }
  return best;
}

} // namespace

std::vector<bool> choosePoissonDisk(std::span<const Vec3u> points, std::span<const std::uint32_t> parts,
                                    std::size_t maxKept) {
  assert(points.size() == parts.size() && maxKept > 0);
  if (points.size() <= maxKept)
    return std::vector<bool>(points.size(), true);
  const DartBoard board{points, parts, orderOf(points)};
  return throwDarts(board, radiusFor(board, maxKept));
}

} // namespace imgeo
