#pragma once
// The distance between two surfaces of triangles.

#include "scene/mesh.h"

#include <cstddef>

namespace imgeo {

/// Distances from points of either surface to the nearest point of the other, in the meshes' units.
struct SurfaceDistance {
  double largest = 0; ///< at all vertices, and at points spread evenly over both surfaces
  double mean = 0;    ///< at the points spread evenly; of the two directions the larger
  friend bool operator==(const SurfaceDistance&, const SurfaceDistance&) = default;
};

/// The number of points at which the surfaces of meshes are compared: two for each triangle of the larger one, at most
/// 100,000.
std::size_t comparedPoints(const Mesh& a, const Mesh& b);

/// Measures the distance between meshes of triangles at their vertices and at comparedPoints() of each. Both have a
/// triangle. Deterministic.
SurfaceDistance distanceBetween(const Mesh& a, const Mesh& b);

} // namespace imgeo
