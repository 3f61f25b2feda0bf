#pragma once
// X3D's ElevationGrid (ISO/IEC 19775-1, 13.3.4): heights over a grid in x and z.

#include "import/x3d/faces.h"

#include <cstdint>
#include <span>

namespace imgeo::x3d {

struct ElevationGrid {
  std::uint32_t columns = 0, rows = 0; ///< at least 2 of each
  double xSpacing = 1, zSpacing = 1;
  std::span<const double> heights; ///< columns * rows of them, row by row
};

/// Appends the grid's vertices and a quadrilateral for each cell. Adds texture coordinates where `data` has none.
/// web/src/tessellate/elevationGrid.ts gives the same; vectors/tessellation/elevationGrid.json tests both.
void addElevationGrid(const ElevationGrid& grid, VertexData& data, Faces& faces);

} // namespace imgeo::x3d
