#include "import/x3d/plane_geometry.h"

#include "import/x3d/round_segments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace imgeo::x3d {

namespace {

using Point = Vec2<double>;

constexpr double fullTurn = 2 * std::numbers::pi;

double sweepOf(const Arc& arc) {
  const double difference = arc.end - arc.start;
  if (difference == 0 || std::abs(difference) >= fullTurn)
    return fullTurn;
  return difference > 0 ? difference : difference + fullTurn;
}

/// The points of an arc, both ends included. The last point of a circle is its first.
std::vector<Point> pointsOf(const Arc& arc) {
  const double sweep = sweepOf(arc), radius = std::abs(arc.radius);
  const int segments = std::max(1, static_cast<int>(std::ceil(sweep / fullTurn * roundSegments - 1e-6)));
  std::vector<Point> points;
  for (int i = 0; i <= segments; ++i) {
    const double angle = arc.start + (sweep == fullTurn && i == segments ? 0 : sweep * i / segments);
    points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return points;
}

void addPositions(std::span<const Point> points, VertexData& data) {
  for (const Point& point : points)
    data.positions.push_back(Vec3f(Vec3d{point.x, point.y, 0}));
}

void addTexCoord(double s, double t, VertexData& data) {
  data.texCoords.push_back({static_cast<float>(s), static_cast<float>(t)});
}

/// The square around a circle of this radius shows the whole texture.
void addSurfacePoints(std::span<const Point> points, double radius, VertexData& data) {
  data.normals = {{0, 0, 1}};
  addPositions(points, data);
  for (const Point& point : points)
    addTexCoord(0.5 + point.x / (2 * radius), 0.5 + point.y / (2 * radius), data);
}

void addSurfaceFace(std::span<const std::uint32_t> points, Faces& faces) {
  for (const std::uint32_t point : points)
    faces.corners.push_back({point, 0, point, none});
  faces.ends.push_back(faces.corners.size());
}

} // namespace

void addArc(const Arc& arc, VertexData& data, Faces& faces) {
  faces.topology = Topology::lines;
  addPositions(pointsOf(arc), data);
  for (std::uint32_t i = 0; i < data.positions.size(); ++i)
    faces.corners.push_back({i, none, none, none});
  faces.ends.push_back(faces.corners.size());
}

void addClosedArc(const Arc& arc, bool isChord, VertexData& data, Faces& faces) {
  std::vector<Point> points = pointsOf(arc);
  if (!isChord)
    points.insert(points.begin(), Point{0, 0});
  addSurfacePoints(points, std::abs(arc.radius), data);
  for (std::uint32_t i = 1; i + 1 < points.size(); ++i) // a fan: arcs of more than half a turn are not convex
    addSurfaceFace(std::array{0u, i, i + 1}, faces);
}

bool addDisk(double innerRadius, double outerRadius, VertexData& data, Faces& faces) {
  const auto [inner, outer] = std::minmax({std::abs(innerRadius), std::abs(outerRadius)});
  if (inner == outer) {
    addArc({outer}, data, faces);
    return false;
  }
  if (inner == 0) {
    addClosedArc({outer}, false, data, faces);
    return true;
  }
  std::vector<Point> points = pointsOf({inner});
  std::ranges::copy(pointsOf({outer}), std::back_inserter(points));
  addSurfacePoints(points, outer, data);
  constexpr std::uint32_t ring = roundSegments + 1;
  for (std::uint32_t i = 0; i + 1 < ring; ++i)
    addSurfaceFace(std::array{i, ring + i, ring + i + 1, i + 1}, faces);
  return true;
}

void addRectangle(Vec2<double> size, VertexData& data, Faces& faces) {
  data.normals = {{0, 0, 1}};
  for (const Point& corner : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}}) {
    addPositions(std::array{Point{size.x * (corner.x - 0.5), size.y * (corner.y - 0.5)}}, data);
    addTexCoord(corner.x, corner.y, data);
  }
  addSurfaceFace(std::array{0u, 1u, 2u, 3u}, faces);
}

} // namespace imgeo::x3d
