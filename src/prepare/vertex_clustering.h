#pragma once
// Vertices gathered in cells: Rossignac and Borrel, "Multi-resolution 3D
// approximations for rendering complex scenes", 1993, as the first step that
// Shaffer and Garland put before edge collapse ("Efficient adaptive simplification
// of massive meshes", 2001): linear time for most of the way.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct VertexClusters {
  std::vector<std::uint32_t> ofVertex;
  std::uint32_t count = 0;
};

/// Every vertex in a cell of its own.
VertexClusters singletonClusters(std::size_t vertexCount);

/// About `cellCount` cells of equal size. Vertices share one where the surface also
/// faces the same octant, so that both sides of a thin wall stay apart; those with
/// `isFixed` have one each. Places are within -1 .. 1; `normals`, one a triangle, are as
/// long as twice its area; `area` is that of all.
VertexClusters clusterVertices(std::span<const Vec3d> places, std::span<const std::uint32_t> corners,
                               std::span<const Vec3d> normals, double area, const std::vector<bool>& isFixed,
                               std::size_t cellCount);

} // namespace imgeo
