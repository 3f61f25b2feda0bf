#pragma once
// Maps disks to rectangles so that surface is sampled evenly: an embedding by mean value coordinates (Floater 2003,
// "Mean value coordinates"), improved by weights that shrink where the map stretches (Yoshizawa, Belyaev and Seidel
// 2004, "A fast and simple stretch-minimizing mesh parameterization").

#include "prepare/geometry_image/chart.h"

#include <array>
#include <span>
#include <vector>

namespace imgeo {

using Vec2d = Vec2<double>;

/// The triangles of a disk, divided where an edge inside of it joins two vertices of its boundary, which an embedding
/// would map onto the border of the rectangle. The boundary is that of the chart.
struct DiskMesh {
  std::vector<Vec3d> points;                 ///< by vertex; the first are the chart's
  std::vector<std::uint32_t> corners;        ///< 3 for each triangle
  std::vector<std::uint32_t> triangles;      ///< by triangle: the triangle of the chart that it is a part of
  std::vector<std::array<Vec3d, 3>> weights; ///< by triangle: barycentric coordinates of its corners in that triangle
  std::vector<std::uint32_t> boundary;       ///< vertices, counterclockwise

  std::size_t triangleCount() const { return triangles.size(); }
};

DiskMesh diskMeshOf(const Mesh& mesh, const Chart& disk);

/// Weights of the neighbours of each vertex: entry h is that of the end of half-edge h for its start.
struct EdgeWeights {
  std::vector<double> forward, backward; ///< backward: of the start of h for its end
};

struct DiskEmbedding {
  std::vector<Vec2d> points; ///< by vertex
  EdgeWeights weights;       ///< with which solve() gives them
  double stretch = 1;        ///< root mean square of how far the map stretches lengths; 1: nowhere
};

/// Embeds a disk whose boundary vertices have these points on the border of a convex region, in the order of
/// DiskMesh::boundary, which is clockwise where y points up.
DiskEmbedding embed(const DiskMesh& disk, std::span<const Vec2d> boundary);

/// The embedding with given weights and another boundary. `guess` are points near the result.
std::vector<Vec2d> solve(const DiskMesh& disk, std::span<const Vec2d> boundary, const EdgeWeights& weights,
                         const std::vector<Vec2d>& guess);

/// See DiskEmbedding::stretch.
double stretchOf(const DiskMesh& disk, const std::vector<Vec2d>& points);

} // namespace imgeo
