#include "prepare/vertex_grid.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

/// A coordinate that unusually many points have, and its index on the grid.
struct Line {
  std::int64_t coordinate = 0, number = 0;
};

/// The grid lines of one axis.
struct Axis {
  double origin = 0, step = 0; ///< in lattice steps
};

/// In lattice steps. Closer lines would save almost nothing.
constexpr std::int64_t minStep = 16;
constexpr std::size_t minLineCount = 4;

/// Grids with more lines are not looked for: time grows with the square of the number.
constexpr std::size_t maxLineCount = 4096;

/// The coordinates that at least `minCount` of `coordinates` equal, ascending.
std::vector<Line> frequent(std::vector<std::uint32_t> coordinates, std::uint32_t low, std::uint32_t high,
                           double minCount) {
  std::vector<Line> lines;
  if (high - low < 65536) {
    std::vector<std::uint32_t> counts(std::size_t{high} - low + 1);
    for (const std::uint32_t coordinate : coordinates)
      ++counts[coordinate - low];
    for (std::size_t i = 0; i < counts.size(); ++i)
      if (counts[i] >= minCount)
        lines.push_back({static_cast<std::int64_t>(low + i), 0});
    return lines;
  }
  std::ranges::sort(coordinates);
  for (auto first = coordinates.begin(); first != coordinates.end();) {
    const auto last = std::upper_bound(first, coordinates.end(), *first);
    if (static_cast<double>(last - first) >= minCount)
      lines.push_back({*first, 0});
    first = last;
  }
  return lines;
}

/// The coordinates with at least four times as many points as a uniform distribution gives.
std::vector<Line> popularCoordinates(std::span<const Vec3u> positions, int axis) {
  std::vector<std::uint32_t> coordinates;
  coordinates.reserve(positions.size());
  std::uint32_t low = UINT32_MAX, high = 0;
  for (const Vec3u& position : positions) {
    coordinates.push_back(position[axis]);
    low = std::min(low, position[axis]);
    high = std::max(high, position[axis]);
  }
  if (coordinates.empty())
    return {};
  const double even = static_cast<double>(positions.size()) / (high - low + 1.0);
  return frequent(std::move(coordinates), low, high, std::max(4.0, 4 * even));
}

/// The most frequent distance of neighbours, the smallest of equals.
std::int64_t frequentDistance(const std::vector<Line>& lines) {
  std::vector<std::int64_t> distances;
  for (std::size_t i = 1; i < lines.size(); ++i)
    distances.push_back(lines[i].coordinate - lines[i - 1].coordinate);
  std::ranges::sort(distances);
  std::int64_t best = 0;
  std::ptrdiff_t bestCount = 0;
  for (auto first = distances.begin(); first != distances.end();) {
    const auto last = std::upper_bound(first, distances.end(), *first);
    if (last - first > bestCount)
      bestCount = last - first, best = *first;
    first = last;
  }
  return best;
}

/// Numbers lines by the most frequent distance of neighbours, which it returns; 0: too small.
std::int64_t numberLines(std::vector<Line>& lines) {
  const std::int64_t distance = frequentDistance(lines);
  if (distance < minStep)
    return 0;
  for (std::size_t i = 1; i < lines.size(); ++i)
    lines[i].number =
        lines[i - 1].number +
        static_cast<std::int64_t>(std::lround(static_cast<double>(lines[i].coordinate - lines[i - 1].coordinate) /
                                              static_cast<double>(distance)));
  return distance;
}

/// The least-squares fit of coordinates over grid indices.
Axis leastSquaresFit(const std::vector<Line>& lines) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Line& line : lines) {
    const auto x = static_cast<double>(line.number), y = static_cast<double>(line.coordinate);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const double step = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {(sy - step * sx) / n, step};
}

/// The origin and step for which every line rounds to its coordinate; `fitted` if there are none.
Axis exactFit(const std::vector<Line>& lines, const Axis& fitted) {
  double minPossibleStep = 0, maxPossibleStep = INFINITY;
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const auto distance = static_cast<double>(lines[j].coordinate - lines[i].coordinate);
      const auto steps = static_cast<double>(lines[j].number - lines[i].number);
      minPossibleStep = std::max(minPossibleStep, (distance - 1) / steps);
      maxPossibleStep = std::min(maxPossibleStep, (distance + 1) / steps);
    }
  if (!(minPossibleStep < maxPossibleStep))
    return fitted;
  const double step = (minPossibleStep + maxPossibleStep) / 2;
  double low = -INFINITY, high = INFINITY;
  for (const Line& line : lines) {
    const double origin = static_cast<double>(line.coordinate) - step * static_cast<double>(line.number);
    low = std::max(low, origin - 0.5);
    high = std::min(high, origin + 0.5);
  }
  return low < high ? Axis{(low + high) / 2, step} : fitted;
}

std::optional<Axis> findAxis(std::span<const Vec3u> positions, int axis) {
  std::vector<Line> lines = popularCoordinates(positions, axis);
  if (lines.size() < minLineCount || lines.size() > maxLineCount || numberLines(lines) == 0)
    return std::nullopt;
  const Axis fitted = leastSquaresFit(lines);
  if (!(fitted.step >= minStep))
    return std::nullopt;
  std::erase_if(lines, [&](const Line& line) {
    return std::abs(fitted.origin + fitted.step * static_cast<double>(line.number) -
                    static_cast<double>(line.coordinate)) > 0.75;
  });
  return lines.size() < minLineCount ? fitted : exactFit(lines, fitted);
}

} // namespace

bool isWorthwhile(const VertexGrid& grid, std::span<const Vec3u> points) {
  std::size_t onGrid = 0;
  for (const Vec3u& point : points)
    onGrid += static_cast<std::size_t>(std::popcount(gridMask(grid, point)));
  return onGrid * 2 > points.size() * 3;
}

std::optional<VertexGrid> findVertexGrid(std::span<const Vec3u> points) {
  std::uint32_t largest = 0;
  for (const Vec3u& point : points)
    largest = std::max({largest, point.x, point.y, point.z});
  VertexGrid grid;
  int missing = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::optional<Axis> found = findAxis(points, axis);
    if (!found) { // a height field has no grid along its height: one line at 0
      if (++missing > 1)
        return std::nullopt;
      grid.step[axis] = std::max<std::uint64_t>(UINT32_MAX, std::uint64_t{largest} << 16 | 65535);
      continue;
    }
    const std::int64_t step = std::llround(found->step * 65536);
    const std::int64_t origin = std::llround(found->origin * 65536) % step;
    grid.step[axis] = static_cast<std::uint64_t>(step);
    grid.origin[axis] = static_cast<std::uint64_t>(origin < 0 ? origin + step : origin);
  }
  return isWorthwhile(grid, points) ? std::optional(grid) : std::nullopt;
}

} // namespace imgeo
