#include "prepare/geometry_image/parametrisation.h"

#include "base/parallel.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

/// A chart whose map stretches more is divided, unless it is of a few triangles.
constexpr double maxStretch = 1.75;
constexpr std::size_t fewTriangles = 32;
/// Texture coordinates that fill a rectangle are kept up to this stretch: they are the author's.
constexpr double maxTexCoordStretch = 3;
/// Larger charts are divided before they are embedded: the equations of a chart take more than linear time.
constexpr std::size_t maxChartTriangles = 32768;

Vec3d pointAt(const Mesh& mesh, const Chart& chart, std::uint32_t halfEdge) {
  return Vec3d(mesh.positions[chart.positions[chart.corners[halfEdge]]]);
}

double triangleArea(Vec3d a, Vec3d b, Vec3d c) {
  return length(cross(b - a, c - a)) / 2;
}

/// Indices of four points of a closed polygon that are the corners of as large a quadrilateral as a search among 48 of
/// them and then between neighbours finds; all of them if there are fewer.
std::vector<std::size_t> farCorners(const std::vector<Vec3d>& loop) {
  std::vector<std::size_t> corners(std::min<std::size_t>(loop.size(), 4));
  std::iota(corners.begin(), corners.end(), std::size_t{0});
  if (loop.size() <= 4)
    return corners;
  std::vector<std::size_t> few;
  const std::size_t count = std::min<std::size_t>(loop.size(), 48);
  for (std::size_t i = 0; i < count; ++i)
    few.push_back(i * loop.size() / count);
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return triangleArea(loop[a], loop[b], loop[c]);
  };
  double largest = -1;
  for (std::size_t i = 0; i + 2 < count; ++i)
    for (std::size_t k = i + 2; k < count && (i > 0 || k + 1 < count); ++k) {
      std::size_t best[2] = {i + 1, (k + 1) % count};
      double areas[2] = {-1, -1};
      for (std::size_t j = 0; j < count; ++j)
        if (j != i && j != k) {
          const bool isBetween = j > i && j < k;
          if (const double a = area(few[i], few[j], few[k]); a > areas[isBetween ? 0 : 1])
            areas[isBetween ? 0 : 1] = a, best[isBetween ? 0 : 1] = j;
        }
      if (areas[0] + areas[1] > largest) {
        largest = areas[0] + areas[1];
        corners = {few[i], few[best[0]], few[k], few[best[1]]};
      }
    }
  std::ranges::sort(corners);
  for (int round = 0; round < 4; ++round)
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t before = corners[(c + 3) % 4], after = corners[(c + 1) % 4];
      double farthest = area(before, corners[c], after);
      for (std::size_t i = (before + 1) % loop.size(); i != after; i = (i + 1) % loop.size())
        if (const double a = area(before, i, after); a > farthest)
          farthest = a, corners[c] = i;
    }
  std::ranges::sort(corners);
  return corners;
}

/// Texture coordinates of the vertices of a chart, if they fill an upright rectangle without overlaps.
struct TexCoordRectangle {
  std::vector<Vec2d> texCoords; ///< by vertex
  Vec2d min, max;
};

std::optional<TexCoordRectangle> texCoordRectangle(const Mesh& mesh, const Chart& chart) {
  if (mesh.texCoords.empty())
    return {};
  TexCoordRectangle rectangle{std::vector<Vec2d>(chart.vertexCount()), {1e300, 1e300}, {-1e300, -1e300}};
  std::vector<bool> isKnown(chart.vertexCount());
  for (std::uint32_t h = 0; h < chart.corners.size(); ++h) {
    const Vec2f texCoord = mesh.texCoords[mesh.corners[3 * chart.triangles[h / 3] + h % 3]];
    const Vec2d point{texCoord.x, texCoord.y};
    Vec2d& known = rectangle.texCoords[chart.corners[h]];
    if (isKnown[chart.corners[h]] && known != point)
      return {};
    isKnown[chart.corners[h]] = true;
    known = point;
    rectangle.min = {std::min(rectangle.min.x, point.x), std::min(rectangle.min.y, point.y)};
    rectangle.max = {std::max(rectangle.max.x, point.x), std::max(rectangle.max.y, point.y)};
  }
  const Vec2d size{rectangle.max.x - rectangle.min.x, rectangle.max.y - rectangle.min.y};
  if (!(size.x > 0 && size.y > 0))
    return {};
  double area = 0;
  int side = 0;
  for (std::size_t t = 0; t < chart.triangleCount(); ++t) {
    const Vec2d &p = rectangle.texCoords[chart.corners[3 * t]], &q = rectangle.texCoords[chart.corners[3 * t + 1]],
                &r = rectangle.texCoords[chart.corners[3 * t + 2]];
    const double doubled = (q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y);
    const int sign = doubled > 0 ? 1 : doubled < 0 ? -1 : 0;
    if (sign == 0 || (side != 0 && sign != side))
      return {};
    side = sign;
    area += std::abs(doubled) / 2;
  }
  if (std::abs(area - size.x * size.y) > 1e-4 * size.x * size.y)
    return {};
  return rectangle;
}

/// The indices in the boundary of the rectangle's corners, from the upper left on. Nothing if it has no vertex there,
/// or a boundary vertex is not on a side.
std::optional<std::vector<std::size_t>> rectangleCorners(const TexCoordRectangle& rectangle, const Chart& chart,
                                                         const std::vector<std::uint32_t>& boundary) {
  const auto& [texCoords, min, max] = rectangle;
  const Vec2d slack{1e-5 * (max.x - min.x), 1e-5 * (max.y - min.y)};
  std::vector<std::size_t> corners;
  std::size_t upperLeft = 0;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Vec2d point = texCoords[chart.corners[boundary[i]]];
    const bool isLeft = point.x <= min.x + slack.x, isRight = point.x >= max.x - slack.x,
               isLow = point.y <= min.y + slack.y, isHigh = point.y >= max.y - slack.y;
    if (!isLeft && !isRight && !isLow && !isHigh)
      return {};
    if ((isLeft || isRight) && (isLow || isHigh)) {
      if (isLeft && isHigh)
        upperLeft = corners.size();
      corners.push_back(i);
    }
  }
  if (corners.size() != 4)
    return {};
  std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(upperLeft));
  return corners;
}

/// Lengths of the sides on the surface.
std::vector<double> sideLengths(const Mesh& mesh, const ParametrisedChart& chart) {
  std::vector<double> lengths(chart.corners.size());
  std::size_t side = 0;
  for (std::size_t i = 0; i < chart.boundary.size(); ++i) {
    if (side + 1 < chart.corners.size() && i == chart.corners[side + 1])
      ++side;
    lengths[side] += length(pointAt(mesh, chart.chart, nextHalfEdge(chart.boundary[i])) -
                            pointAt(mesh, chart.chart, chart.boundary[i]));
  }
  return lengths;
}

/// The points of the boundary on the border of the unit square, by arc length between the corners.
std::vector<Vec2d> unitBorder(const Mesh& mesh, const ParametrisedChart& chart) {
  const std::vector<double> lengths = sideLengths(mesh, chart);
  std::vector<Vec2d> points;
  std::size_t side = 0;
  double along = 0;
  for (std::size_t i = 0; i < chart.boundary.size(); ++i) {
    if (side + 1 < chart.corners.size() && i == chart.corners[side + 1])
      ++side, along = 0;
    const double sides = side + 1 == chart.corners.size() ? 4.0 - static_cast<double>(side) : 1; // 2 of a triangle
    const double share = lengths[side] > 0 ? along / lengths[side] : 0;
    points.push_back(borderPoint(static_cast<double>(side) + sides * share, {1, 1}));
    along += length(pointAt(mesh, chart.chart, nextHalfEdge(chart.boundary[i])) -
                    pointAt(mesh, chart.chart, chart.boundary[i]));
  }
  return points;
}

/// Begins the boundary with the first of the corners.
void rotateToFirstCorner(ParametrisedChart& chart) {
  const std::size_t first = chart.corners[0], count = chart.boundary.size();
  for (std::size_t& corner : chart.corners)
    corner = (corner + count - first) % count;
  std::ranges::rotate(chart.boundary, chart.boundary.begin() + static_cast<std::ptrdiff_t>(first));
  std::ranges::rotate(chart.disk.boundary, chart.disk.boundary.begin() + static_cast<std::ptrdiff_t>(first));
}

void measure(const Mesh& mesh, ParametrisedChart& chart) {
  for (std::uint32_t t = 0; t < chart.chart.triangleCount(); ++t)
    chart.area += triangleArea(pointAt(mesh, chart.chart, 3 * t), pointAt(mesh, chart.chart, 3 * t + 1),
                               pointAt(mesh, chart.chart, 3 * t + 2));
  const std::vector<double> lengths = sideLengths(mesh, chart);
  if (lengths.size() < 4)
    return;
  const double width = lengths[1] + lengths[3], height = lengths[0] + lengths[2];
  chart.aspect = height > 0 && width > 0 ? std::clamp(width / height, 1.0 / 16, 16.0) : 1;
}

/// Maps the chart by its texture coordinates. Returns false where they do not fill a rectangle.
bool keepTexCoords(const Mesh& mesh, ParametrisedChart& chart) {
  const std::optional<TexCoordRectangle> rectangle = texCoordRectangle(mesh, chart.chart);
  if (!rectangle)
    return false;
  const std::optional<std::vector<std::size_t>> corners = rectangleCorners(*rectangle, chart.chart, chart.boundary);
  if (!corners)
    return false;
  chart.corners = *corners;
  rotateToFirstCorner(chart);
  const auto texCoordOf = [&](std::size_t corner) {
    return rectangle->texCoords[chart.chart.corners[chart.boundary[chart.corners[corner]]]];
  };
  const Vec2d origin = texCoordOf(0), down = texCoordOf(1), right = texCoordOf(3);
  const auto share = [&](Vec2d point, Vec2d end) {
    const Vec2d side{end.x - origin.x, end.y - origin.y};
    return ((point.x - origin.x) * side.x + (point.y - origin.y) * side.y) / (side.x * side.x + side.y * side.y);
  };
  std::vector<Vec2d>& points = chart.embedding.points;
  points.resize(chart.disk.points.size());
  const auto atCorner = [&](std::uint32_t triangle, std::uint32_t s) {
    const Vec2d point = rectangle->texCoords[chart.chart.corners[3 * triangle + s]];
    return Vec2d{share(point, right), share(point, down)};
  };
  for (std::size_t h = 0; h < chart.disk.corners.size(); ++h) {
    const std::uint32_t triangle = chart.disk.triangles[h / 3];
    const Vec3d weights = chart.disk.weights[h / 3][h % 3];
    Vec2d point;
    for (std::uint32_t s = 0; s < 3; ++s) {
      const Vec2d corner = atCorner(triangle, s);
      point = {point.x + weights[static_cast<int>(s)] * corner.x, point.y + weights[static_cast<int>(s)] * corner.y};
    }
    points[chart.disk.corners[h]] = point;
  }
  chart.embedding.stretch = stretchOf(chart.disk, points);
  chart.keepsTexCoords = true;
  measure(mesh, chart);
  return true;
}

/// The chart with a map to a rectangle; nothing if it has to be divided.
std::optional<ParametrisedChart> mapped(const Mesh& mesh, const Chart& chart) {
  if (!isDisk(chart))
    return {};
  ParametrisedChart result;
  result.chart = chart;
  result.boundary = boundaryOf(chart);
  if (result.boundary.size() < 3) // a pocket: a rectangle needs three of its corners at vertices
    return {};
  result.disk = diskMeshOf(mesh, chart);
  ParametrisedChart byTexCoords = result;
  if (keepTexCoords(mesh, byTexCoords) && byTexCoords.embedding.stretch <= maxTexCoordStretch)
    return byTexCoords;
  if (chart.triangleCount() > maxChartTriangles)
    return {};
  std::vector<Vec3d> loop;
  for (const std::uint32_t halfEdge : result.boundary)
    loop.push_back(pointAt(mesh, chart, halfEdge));
  result.corners = farCorners(loop);
  rotateToFirstCorner(result);
  measure(mesh, result);
  std::vector<Vec2d> border = unitBorder(mesh, result);
  for (Vec2d& point : border)
    point.x *= result.aspect;
  result.embedding = embed(result.disk, border);
  if (result.embedding.stretch > maxStretch && chart.triangleCount() > fewTriangles)
    return {};
  for (Vec2d& point : result.embedding.points)
    point.x /= result.aspect;
  return result;
}

} // namespace

Vec2d borderPoint(double distance, Vec2d size) {
  if (distance <= size.y)
    return {0, distance};
  distance -= size.y;
  if (distance <= size.x)
    return {distance, size.y};
  distance -= size.x;
  if (distance <= size.y)
    return {size.x, size.y - distance};
  distance -= size.y;
  return {std::max(size.x - distance, 0.0), 0};
}

std::vector<ParametrisedChart> parametrise(const Mesh& mesh) {
  std::vector<ParametrisedChart> result;
  std::vector<Chart> open = chartsOf(mesh);
  while (!open.empty()) {
    std::vector<std::optional<ParametrisedChart>> maps(open.size());
    std::vector<std::array<Chart, 2>> halves(open.size());
    parallelFor(open.size(), [&](std::size_t i) {
      maps[i] = mapped(mesh, open[i]);
      if (!maps[i])
        halves[i] = divide(mesh, open[i]);
    });
    open.clear();
    for (std::size_t i = 0; i < maps.size(); ++i)
      if (maps[i])
        result.push_back(*std::move(maps[i]));
      else
        std::ranges::move(halves[i], std::back_inserter(open));
  }
  return result;
}

} // namespace imgeo
