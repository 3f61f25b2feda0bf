#pragma once
// A tree of boxes over the triangles of a mesh, which finds those near a point.

#include "scene/mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace imgeo {

struct Triangle {
  Vec3d a, b, c;
  std::uint32_t index = 0; ///< of its first corner in the mesh, by 3
};

/// The triangles of a mesh of triangles.
std::vector<Triangle> meshTriangles(const Mesh& mesh);

/// A point of a triangle.
struct TrianglePoint {
  Vec3d weights;              ///< barycentric coordinates
  double squaredDistance = 0; ///< from the point that it is nearest to
};

/// The point of a triangle, which may be degenerate, that is nearest to `p`.
TrianglePoint nearestPoint(Vec3d p, const Triangle& triangle);

class TriangleTree {
public:
  /// There is at least one triangle.
  explicit TriangleTree(std::vector<Triangle> triangles);

  /// The distance of a point from the nearest triangle.
  double distance(Vec3d point) const;

  /// Calls visit(triangle, nearest point) for each triangle within `distance` of a point.
  template <typename Visit> void visitWithin(Vec3d point, double distance, const Visit& visit) const {
    const double squared = distance * distance;
    search(
        point,
        [&](const Triangle& triangle) {
          if (const TrianglePoint nearest = nearestPoint(point, triangle); nearest.squaredDistance <= squared)
            visit(triangle, nearest);
          return squared;
        },
        squared);
  }

private:
  struct Node {
    Box3d box;
    std::uint32_t begin = 0, end = 0; ///< triangles of a leaf
    std::uint32_t right = 0;          ///< the second child; the first follows its parent. 0: a leaf
  };

  void build(std::span<Triangle> range);

  /// Calls visit(triangle) for each triangle whose leaf is within a squared distance, nearer leaves first as far as
  /// siblings go. `visit` returns the squared distance for those that follow.
  template <typename Visit> void search(Vec3d point, const Visit& visit, double squared) const {
    std::array<std::uint32_t, 128> open{};
    std::size_t count = 1;
    while (count > 0) {
      const std::uint32_t index = open[--count];
      const Node& node = nodes_[index];
      if (squaredDistance(point, node.box) > squared)
        continue;
      if (node.right == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i)
          squared = visit(triangles_[i]);
        continue;
      }
      std::uint32_t near = index + 1, far = node.right;
      if (squaredDistance(point, nodes_[far].box) < squaredDistance(point, nodes_[near].box))
        std::swap(near, far);
      open[count++] = far;
      open[count++] = near;
    }
  }

  static double squaredDistance(Vec3d point, const Box3d& box);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

} // namespace imgeo
