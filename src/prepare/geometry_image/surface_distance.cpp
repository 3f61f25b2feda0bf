#include "prepare/geometry_image/surface_distance.h"

#include "base/narrow.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <span>

namespace imgeo {

namespace {

struct Triangle {
  Vec3d a, b, c;
};

std::vector<Triangle> trianglesOf(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (std::size_t corner = 0; corner + 2 < mesh.corners.size(); corner += 3)
    triangles.push_back({Vec3d(mesh.cornerPosition(corner)), Vec3d(mesh.cornerPosition(corner + 1)),
                         Vec3d(mesh.cornerPosition(corner + 2))});
  return triangles;
}

/// The square of the distance of a point from a triangle, which may be degenerate (Ericson, "Real-Time Collision
/// Detection", 5.1.5).
double squaredDistance(Vec3d p, const Triangle& t) {
  const auto squared = [](Vec3d v) { return dot(v, v); };
  const auto toSegment = [&](Vec3d a, Vec3d b) {
    const Vec3d ab = b - a;
    const double whole = squared(ab), share = whole > 0 ? std::clamp(dot(p - a, ab) / whole, 0.0, 1.0) : 0;
    return squared(p - (a + ab * share));
  };
  const Vec3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, normal = cross(ab, ac);
  const double area = squared(normal);
  if (area > 0) {
    const double v = dot(cross(ap, ac), normal) / area, w = dot(cross(ab, ap), normal) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) {
      const double height = dot(ap, normal);
      return height * height / area;
    }
  }
  return std::min({toSegment(t.a, t.b), toSegment(t.b, t.c), toSegment(t.c, t.a)});
}

/// A tree of boxes over triangles.
class TriangleTree {
public:
  explicit TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
    assert(!triangles_.empty());
    nodes_.reserve(triangles_.size());
    build(triangles_);
  }

  double distance(Vec3d point) const {
    std::array<std::uint32_t, 128> open{};
    std::size_t count = 1;
    double best = std::numeric_limits<double>::infinity();
    while (count > 0) {
      const Node& node = nodes_[open[--count]];
      if (squaredDistance(point, node.box) >= best)
        continue;
      if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i)
          best = std::min(best, imgeo::squaredDistance(point, triangles_[i]));
        continue;
      }
      std::uint32_t near = narrow<std::uint32_t>(&node - nodes_.data()) + 1, far = node.right;
      if (squaredDistance(point, nodes_[far].box) < squaredDistance(point, nodes_[near].box))
        std::swap(near, far);
      open[count++] = far;
      open[count++] = near;
    }
    return std::sqrt(best);
  }

private:
  struct Node {
    Box3d box;
    std::uint32_t begin = 0, end = 0; ///< triangles of a leaf
    std::uint32_t right = 0;          ///< the second child; the first follows its parent. 0: a leaf
  };

  static double squaredDistance(Vec3d point, const Box3d& box) {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double off = std::max({box.min[axis] - point[axis], 0.0, point[axis] - box.max[axis]});
      sum += off * off;
    }
    return sum;
  }

  /// Halves a range of triangles at the median along its box's longest axis.
  void build(std::span<Triangle> range) {
    const std::size_t index = nodes_.size();
    Node node;
    for (const Triangle& triangle : range)
      for (const Vec3d& point : {triangle.a, triangle.b, triangle.c})
        node.box.add(point);
    node.begin = narrow<std::uint32_t>(range.data() - triangles_.data());
    node.end = narrow<std::uint32_t>(node.begin + range.size());
    nodes_.push_back(node);
    if (range.size() <= 4)
      return;
    const Vec3d size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = range.size() / 2;
    std::ranges::nth_element(range, range.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [axis](const Triangle& t) { return t.a[axis] + t.b[axis] + t.c[axis]; });
    build(range.first(half));
    nodes_[index].right = narrow<std::uint32_t>(nodes_.size());
    build(range.subspan(half));
  }

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

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
  const std::vector<Triangle> ofA = trianglesOf(a), ofB = trianglesOf(b);
  const SurfaceDistance there = distanceFrom(a, ofA, TriangleTree(ofB), pointCount),
                        back = distanceFrom(b, ofB, TriangleTree(ofA), pointCount);
  return {std::max(there.largest, back.largest), std::max(there.mean, back.mean)};
}

} // namespace imgeo
