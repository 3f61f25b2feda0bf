#pragma once
// Vertex clustering in the cells of a grid (Rossignac and Borrel, "Multi-resolution 3D approximations for rendering
// complex scenes", 1993). As in Shaffer and Garland, "Efficient adaptive simplification of massive meshes", 2001, it
// takes linear time and precedes edge collapse.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct VertexClusters {
  std::vector<std::uint32_t> clusterOf; ///< vertex -> cluster
  std::uint32_t count = 0;
};

/// Every vertex in a cluster of its own.
VertexClusters singletonClusters(std::size_t vertexCount);

/// Clusters vertices by the cells of a grid, whose cell size is chosen so that the surface touches about `clusterCount`
/// cells. The vertices of a cluster also have normals in the same octant, so that the two sides of a thin wall stay
/// separate. Each vertex with `isFixed` has a cluster of its own. `points` are within -1 .. 1. `normals` has one normal
/// for each triangle, whose length is twice the triangle's area; `area` is the sum of the areas.
VertexClusters clusterVertices(std::span<const Vec3d> points, std::span<const std::uint32_t> corners,
                               std::span<const Vec3d> normals, double area, const std::vector<bool>& isFixed,
                               std::size_t clusterCount);

} // namespace imgeo
