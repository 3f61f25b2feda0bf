#pragma once
// Geometry images (Gu, Gortler and Hoppe 2002): a surface sampled on regular grids, one for each chart.

#include "prepare/geometry_image/parametrisation.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// A grid of vertices, row by row; every cell is a piece of the surface. Where columns run to the right and rows down,
/// its front is that of the mesh.
struct GeometryImage : VertexAttributes {
  std::uint32_t columns = 0, rows = 0;
  std::vector<Vec3f> positions;
};

/// Samples a mesh on one grid for each chart, which have about gridEdge * gridEdge vertices together: each as many as
/// its share of the surface. A grid has at least a cell for each chart that it meets, and 2 to `maxEdge` columns and
/// rows. Grids meet at the same points, bit for bit. Attributes are interpolated in the mesh's triangles; normals have
/// unit length.
///
/// Throws Error{limit} if a chart meets more charts than a grid of `maxEdge` has cells on a side.
std::vector<GeometryImage> geometryImages(const Mesh& mesh, std::span<const ParametrisedChart> charts,
                                          std::uint32_t gridEdge, std::uint32_t maxEdge);

} // namespace imgeo
