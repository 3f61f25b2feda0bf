#include "prepare/triangle_tree.h"

#include "base/narrow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace imgeo {

std::vector<Triangle> meshTriangles(const Mesh& mesh) {
  std::vector<Triangle> triangles;
  for (std::size_t corner = 0; corner + 2 < mesh.corners.size(); corner += 3)
    triangles.push_back({Vec3d(mesh.cornerPosition(corner)), Vec3d(mesh.cornerPosition(corner + 1)),
                         Vec3d(mesh.cornerPosition(corner + 2)), narrow<std::uint32_t>(corner / 3)});
  return triangles;
}

// Ericson, "Real-Time Collision Detection", 5.1.5.
TrianglePoint nearestPoint(Vec3d p, const Triangle& t) {
  const auto squared = [](Vec3d v) { return dot(v, v); };
  const Vec3d ab = t.b - t.a, ac = t.c - t.a, ap = p - t.a, normal = cross(ab, ac);
  const double area = squared(normal);
  if (area > 0) {
    const double v = dot(cross(ap, ac), normal) / area, w = dot(cross(ab, ap), normal) / area;
    if (v >= 0 && w >= 0 && v + w <= 1) {
      const double height = dot(ap, normal);
      return {{1 - v - w, v, w}, height * height / area};
    }
  }
  TrianglePoint nearest{{}, std::numeric_limits<double>::infinity()};
  const auto addEdge = [&](Vec3d from, Vec3d to, int first, int second) {
    const Vec3d edge = to - from;
    const double whole = squared(edge), share = whole > 0 ? std::clamp(dot(p - from, edge) / whole, 0.0, 1.0) : 0;
    const double distance = squared(p - (from + edge * share));
    if (distance >= nearest.squaredDistance)
      return;
    nearest = {{}, distance};
    nearest.weights[first] = 1 - share;
    nearest.weights[second] = share;
  };
  addEdge(t.a, t.b, 0, 1);
  addEdge(t.b, t.c, 1, 2);
  addEdge(t.c, t.a, 2, 0);
  return nearest;
}

TriangleTree::TriangleTree(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  assert(!triangles_.empty());
  nodes_.reserve(triangles_.size());
  build(triangles_);
}

double TriangleTree::distance(Vec3d point) const {
  double best = std::numeric_limits<double>::infinity();
  search(
      point,
      [&](const Triangle& triangle) { return best = std::min(best, nearestPoint(point, triangle).squaredDistance); },
      best);
  return std::sqrt(best);
}

double TriangleTree::squaredDistance(Vec3d point, const Box3d& box) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double off = std::max({box.min[axis] - point[axis], 0.0, point[axis] - box.max[axis]});
    sum += off * off;
  }
  return sum;
}

/// Halves a range of triangles at the median along its box's longest axis.
void TriangleTree::build(std::span<Triangle> range) {
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

} // namespace imgeo
