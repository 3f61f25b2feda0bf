#pragma once
// Where the cells of a height grid are in the scene: metres to the east (x), up (y) and to the south (z).

#include "base/vec.h"
#include "import/dem/height_grid.h"

#include <string>
#include <vector>

namespace imgeo {

struct Ground {
  /// Coordinates of the reference system (or column and row, where the file states no cell size) at the scene's x and z
  /// of 0, the centre of the grid.
  Vec2<double> origin;
  Vec2<double> metresPerUnit{1, 1}; ///< of these coordinates, to the east and to the north
  Vec2<double> columnStep{1, 0};    ///< x and z from a cell to the next one in its row
  Vec2<double> rowStep{0, 1};       ///< and in its column
  double metresPerHeight = 1;       ///< of the file's numbers
  std::vector<std::string> notes;   ///< one sentence for each thing that the file does not state
};

/// Degrees become metres by the length of a degree at the grid's centre, on the system's ellipsoid. Where the file
/// states no cell size, a cell is a metre wide and the heights are shown over a tenth of the grid's longer side. Throws
/// Error{malformed} with `name` for a grid without any height.
Ground groundOf(const HeightGrid& grid, const std::string& name);

} // namespace imgeo
