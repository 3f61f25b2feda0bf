#include "prepare/geometry_image/surface_distance.h"

#include "base/parallel.h"
#include "prepare/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace imgeo {

namespace {

/// Points spread evenly over triangles: one in each of so many parts of equal area.
std::vector<Vec3d> evenPoints(const std::vector<Triangle>& triangles, std::size_t count) {
  std::vector<double> areas;
  double area = 0;
  for (const Triangle& t : triangles)
    areas.push_back(area += length(cross(t.b - t.a, t.c - t.a)));
  std::vector<Vec3d> points;
  if (!(area > 0))
    return points;
  std::size_t at = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double areaBefore = area * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    while (at + 1 < areas.size() && areas[at] < areaBefore)
      ++at;
    // The plastic number's sequence fills the square evenly (Roberts 2018).
    double u = std::fmod(0.5 + 0.7548776662466927 * static_cast<double>(i), 1.0),
           v = std::fmod(0.5 + 0.5698402909980532 * static_cast<double>(i), 1.0);
    if (u + v > 1)
      u = 1 - u, v = 1 - v;
    const Triangle& t = triangles[at];
    points.push_back(t.a + (t.b - t.a) * u + (t.c - t.a) * v);
  }
  return points;
}

struct Distances {
  double largest = 0, sum = 0;
};

Distances distancesOf(std::span<const Vec3d> points, const TriangleTree& tree) {
  constexpr std::size_t blockSize = 1024;
  std::vector<Distances> blocks((points.size() + blockSize - 1) / blockSize);
  parallelFor(blocks.size(), [&](std::size_t block) {
    for (const Vec3d& point :
         points.subspan(block * blockSize).first(std::min(blockSize, points.size() - block * blockSize))) {
      const double distance = tree.distance(point);
      blocks[block].largest = std::max(blocks[block].largest, distance);
      blocks[block].sum += distance;
    }
  });
  Distances result;
  for (const Distances& block : blocks)
    result = {std::max(result.largest, block.largest), result.sum + block.sum};
  return result;
}

SurfaceDistance distanceFrom(const Mesh& mesh, const std::vector<Triangle>& triangles, const TriangleTree& other,
                             std::size_t pointCount) {
  std::vector<bool> isUsed(mesh.positions.size());
  for (const std::uint32_t wedge : mesh.corners)
    isUsed[mesh.wedgePositions[wedge]] = true;
  std::vector<Vec3d> vertices;
  for (std::size_t i = 0; i < isUsed.size(); ++i)
    if (isUsed[i])
      vertices.emplace_back(mesh.positions[i]);
  const std::vector<Vec3d> points = evenPoints(triangles, pointCount);
  const Distances atVertices = distancesOf(vertices, other), atPoints = distancesOf(points, other);
  return {std::max(atVertices.largest, atPoints.largest),
          points.empty() ? 0 : atPoints.sum / static_cast<double>(points.size())};
}

} // namespace

std::size_t comparedPoints(const Mesh& a, const Mesh& b) {
  return std::min<std::size_t>(2 * std::max(a.elementCount(), b.elementCount()), 100'000);
}

SurfaceDistance distanceBetween(const Mesh& a, const Mesh& b) {
  const std::size_t pointCount = comparedPoints(a, b);
  const std::vector<Triangle> ofA = meshTriangles(a), ofB = meshTriangles(b);
  const SurfaceDistance there = distanceFrom(a, ofA, TriangleTree(ofB), pointCount),
                        back = distanceFrom(b, ofB, TriangleTree(ofA), pointCount);
  return {std::max(there.largest, back.largest), std::max(there.mean, back.mean)};
}

} // namespace imgeo
