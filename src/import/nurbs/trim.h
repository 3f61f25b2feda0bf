#pragma once
// Cuts the rectangular cells of a surface's parameters along trimming contours.

#include "base/vec.h"

#include <cstddef>
#include <vector>

namespace imgeo::nurbs {

using Parameters = Vec2<double>;      ///< u and v
using Loop = std::vector<Parameters>; ///< a closed polygon: its last corner is joined to its first

/// A convex polygon inside of one cell, counter-clockwise. Corners may lie on its edges: all polygons together meet
/// corner to corner.
struct CellPolygon {
  std::size_t column = 0, row = 0;
  std::vector<Parameters> corners;
};

/// Limit of the number of corners of all contours of one surface.
inline constexpr std::size_t maxContourCorners = 20'000;

/// The cells between ascending parameters `us` and `vs`, at least two of each. Without loops all of them; else what
/// lies within an odd number of loops: an outer contour and the holes in it, whatever their orientation. Corners beyond
/// the cells are moved to their border.
std::vector<CellPolygon> cells(const std::vector<double>& us, const std::vector<double>& vs,
                               const std::vector<Loop>& loops);

} // namespace imgeo::nurbs
