#include "transcode/source/guess_up.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace imgeo {

namespace {

using Point = Vec2<double>;

/// Twice the signed area of the triangle o, a, b.
double turn(Point o, Point a, Point b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Removes most points that are not on the convex hull: those inside the octagon of the points that are farthest along
/// the axes and diagonals (Akl and Toussaint 1978).
void removeInnerPoints(std::vector<Point>& points) {
  constexpr std::array<Point, 8> directions{{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  if (points.empty())
    return;
  std::array<Point, 8> octagon;
  for (std::size_t i = 0; i < octagon.size(); ++i) {
    const auto along = [&](Point point) { return directions[i].x * point.x + directions[i].y * point.y; };
    std::size_t farthest = 0;
    double maximum = along(points.front());
    for (std::size_t j = 1; j < points.size(); ++j)
      if (const double reached = along(points[j]); reached > maximum)
        maximum = reached, farthest = j;
    octagon[i] = points[farthest];
  }
  struct Side {
    Point from, to;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < octagon.size(); ++i)
    if (const Side side{octagon[i], octagon[(i + 1) % octagon.size()]};
        side.from.x != side.to.x || side.from.y != side.to.y)
      sides.push_back(side);
  // Most points are inside a circle that touches the nearest side.
  Point center;
  for (const Point corner : octagon)
    center = {center.x + corner.x / octagon.size(), center.y + corner.y / octagon.size()};
  double radius = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : sides)
    radius = std::min(radius, turn(from, to, center) / std::hypot(to.x - from.x, to.y - from.y));
  const double inner = radius > 0 ? 0.99 * radius : 0;
  std::erase_if(points, [&](Point point) {
    const double x = point.x - center.x, y = point.y - center.y;
    return x * x + y * y < inner * inner ||
           std::ranges::all_of(sides, [&](const Side& side) { return turn(side.from, side.to, point) > 0; });
  });
}

/// The convex hull, counterclockwise (Andrew 1979).
std::vector<Point> convexHull(std::vector<Point> points) {
  removeInnerPoints(points);
  std::ranges::sort(points, [](Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Point> hull;
  const auto addChain = [&](const auto& begin, const auto& end) {
    const std::size_t first = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), *point) <= 0)
        hull.pop_back();
      hull.push_back(*point);
    }
    if (!hull.empty())
      hull.pop_back(); // the first point of the other chain
  };
  addChain(points.begin(), points.end());
  addChain(points.rbegin(), points.rend());
  return hull;
}

double areaOf(const std::vector<Point>& polygon) {
  double area = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    area += turn(polygon[0], polygon[i - 1], polygon[i]) / 2;
  return area;
}

bool isInside(const std::vector<Point>& hull, Point point) {
  for (std::size_t i = 0; i < hull.size(); ++i)
    if (turn(hull[i], hull[(i + 1) % hull.size()], point) < 0)
      return false;
  return hull.size() >= 3;
}

/// What the samples show along one axis, as if it pointed up.
struct AxisEvidence {
  double height = 0;   ///< extent without the outermost thousandth of the samples at each end
  double foot = 0;     ///< share of the ground plan that the lowest samples span; 0 if the centre is not above them
  double top = 0;      ///< the same of the highest samples
  double facing = 0;   ///< mean of the normals' components, -1..1: 0 for closed surfaces, 1 for a level plane
  double layering = 1; ///< for points, see layeringOf
  bool onZero = false; ///< the lowest samples have the coordinate 0
};

/// The mean extent of the samples along an axis above a cell of the ground plan, as a share of their height: small for
/// one layer of points, about 1 for walls and closed surfaces.
double layeringOf(int axis, const std::vector<SurfaceSample>& samples, const Box3d& box) {
  constexpr std::size_t cells = 48;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3d size = box.size();
  std::vector<Vec2<double>> ranges(cells * cells, {box.max[axis], box.min[axis]}); // lowest and highest of each cell
  for (const SurfaceSample& sample : samples) {
    const auto cellAlong = [&](int side) {
      const double share = (sample.point[side] - box.min[side]) / size[side];
      return std::min(cells - 1, static_cast<std::size_t>(share * cells));
    };
    Vec2<double>& range = ranges[cellAlong(u) * cells + cellAlong(v)];
    range = {std::min(range.x, sample.point[axis]), std::max(range.y, sample.point[axis])};
  }
  double sum = 0, occupied = 0;
  for (const Vec2<double>& range : ranges)
    if (range.x < range.y) // at least two samples
      sum += (range.y - range.x) / size[axis], ++occupied;
  return occupied > 0 ? sum / occupied : 1;
}

/// Thickness of the lowest and highest samples as a share of the box's diagonal: feet are not exactly level.
constexpr double slice = 0.02;

AxisEvidence evidenceAlong(int axis, const std::vector<SurfaceSample>& samples, double diagonal) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double count = static_cast<double>(samples.size());
  AxisEvidence evidence;
  std::vector<double> heights;
  std::vector<Point> plan, lowest, highest;
  Point center;
  for (const SurfaceSample& sample : samples) {
    heights.push_back(sample.point[axis]);
    plan.push_back({sample.point[u], sample.point[v]});
    center = {center.x + plan.back().x / count, center.y + plan.back().y / count};
    evidence.facing += static_cast<double>(sample.normal[axis]) / count;
  }
  const std::size_t outliers = samples.size() / 1000;
  std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(outliers));
  const double low = heights[outliers];
  std::ranges::nth_element(heights, heights.end() - 1 - static_cast<std::ptrdiff_t>(outliers));
  const double high = heights[heights.size() - 1 - outliers];
  evidence.height = high - low;
  evidence.onZero = std::abs(low) <= 0.002 * diagonal;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].point[axis] <= low + slice * diagonal)
      lowest.push_back(plan[i]);
    if (samples[i].point[axis] >= high - slice * diagonal)
      highest.push_back(plan[i]);
  }
  const double planArea = areaOf(convexHull(std::move(plan)));
  if (!(planArea > 0))
    return evidence;
  const std::vector<Point> footHull = convexHull(std::move(lowest));
  evidence.foot = isInside(footHull, center) ? areaOf(footHull) / planArea : 0;
  evidence.top = areaOf(convexHull(std::move(highest))) / planArea;
  return evidence;
}

constexpr std::array positiveAxes{AxisDirection::x, AxisDirection::y, AxisDirection::z};

/// The lesser extent across an axis.
double widthAcross(int axis, const std::array<AxisEvidence, 3>& evidence) {
  return std::min(evidence[(axis + 1) % 3].height, evidence[(axis + 2) % 3].height);
}

/// Whether only the samples that are lowest along this axis have the coordinate 0.
bool isAloneOnZero(int axis, const std::array<AxisEvidence, 3>& evidence) {
  return evidence[axis].onZero && evidence[axis].foot > 0 && !evidence[(axis + 1) % 3].onZero &&
         !evidence[(axis + 2) % 3].onZero;
}

/// Whether both ends along this axis are flat, no other ends are, and it is the longest axis.
bool isColumn(int axis, const std::array<AxisEvidence, 3>& evidence) {
  const AxisEvidence &along = evidence[axis], &u = evidence[(axis + 1) % 3], &v = evidence[(axis + 2) % 3];
  return std::min(along.foot, along.top) > 0.5 && std::max({u.foot, u.top, v.foot, v.top}) < 0.5 &&
         along.height > 1.5 * std::max(u.height, v.height);
}

/// Whether the shape is low for its ground plan, as cities are, with less at the top than at the foot.
bool isWide(int axis, const std::array<AxisEvidence, 3>& evidence) {
  const AxisEvidence& along = evidence[axis];
  return along.height <= 0.5 * widthAcross(axis, evidence) && along.foot >= 0.5 && along.foot - along.top >= 0.1;
}

/// An axis is chosen from this score on, and instead of y from this difference of scores on.
constexpr double decisive = 0.15;

double scoreOf(int axis, const std::array<AxisEvidence, 3>& evidence) {
  const AxisEvidence& along = evidence[axis];
  return along.foot - along.top + 0.5 * along.facing + (isAloneOnZero(axis, evidence) ? 0.2 : 0) +
         (isColumn(axis, evidence) ? 0.5 : 0) + (isWide(axis, evidence) ? 0.2 : 0);
}

int percent(double share) {
  return static_cast<int>(std::lround(100 * share));
}

std::string reasonFor(int axis, const std::array<AxisEvidence, 3>& evidence) {
  const AxisEvidence& along = evidence[axis];
  const char* const name = nameOf(positiveAxes[axis]);
  if (isColumn(axis, evidence))
    return fmt::format("it is longest along {}, between two flat ends, as a column is", name);
  if (along.foot - along.top >= decisive || !isAloneOnZero(axis, evidence))
    return fmt::format("it stands upright along {}: its lowest points span {} % of its ground plan, its highest {} %",
                       name, percent(along.foot), percent(along.top));
  return fmt::format("it stands on the plane {} = 0", name);
}

} // namespace

UpGuess guessUp(const std::vector<SurfaceSample>& samples) {
  UpGuess undecided{AxisDirection::y, "its shape does not tell which axis is up"};
  Box3d box;
  for (const SurfaceSample& sample : samples)
    box.add(sample.point);
  const double diagonal = length(box.size());
  if (samples.size() < 100 || !(diagonal > 0))
    return undecided;
  std::array<AxisEvidence, 3> evidence;
  for (int axis = 0; axis < 3; ++axis)
    evidence[axis] = evidenceAlong(axis, samples, diagonal);

  if (std::ranges::any_of(evidence, [&](const AxisEvidence& along) { return along.height < 1e-4 * diagonal; }))
    return {AxisDirection::y, "it is flat, and a picture stands while a floor lies"};

  const bool havePoints = samples.front().normal == Vec3f{};
  if (havePoints)
    for (int axis = 0; axis < 3; ++axis)
      evidence[axis].layering = layeringOf(axis, samples, box);

  // A terrain. Faces and reliefs, which stand, are open sheets as well, but deeper for their size or steeper.
  for (int axis = 0; axis < 3; ++axis) {
    const double facing = std::abs(evidence[axis].facing),
                 thinness = evidence[axis].height / widthAcross(axis, evidence);
    if (facing >= 0.4 && thinness <= (facing >= 0.7 ? 0.5 : 0.35))
      return {positiveAxes[axis],
              fmt::format("it is thin along {}, and {} % of its surface faces that side, as a terrain's does",
                          nameOf(positiveAxes[axis]), percent(facing))};
    if (havePoints && (thinness <= 0.05 || (thinness <= 0.35 && evidence[axis].layering <= 0.4) ||
                       (thinness <= 0.5 && evidence[axis].layering <= 0.15)))
      return {positiveAxes[axis],
              fmt::format("its points are one thin layer across {}, as a terrain's are", nameOf(positiveAxes[axis]))};
  }

  std::array<double, 3> scores{};
  for (int axis = 0; axis < 3; ++axis)
    scores[axis] = scoreOf(axis, evidence);
  const int best = static_cast<int>(std::ranges::max_element(scores) - scores.begin());
  constexpr int y = 1;
  const bool isNearY = scores[best] < scores[y] + decisive && scores[best] < 2 * scores[y];
  if (scores[best] < decisive || (best != y && isNearY))
    return undecided;
  return {positiveAxes[best], reasonFor(best, evidence)};
}

} // namespace imgeo
