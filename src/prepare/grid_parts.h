#pragma once
// Cuts grids of vertices into parts that fit into images.

#include "base/vec.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// A part of a grid of vertices. Neighbours share a column or a row.
struct GridPart {
  Vec2<std::uint32_t> origin, size; ///< column and row of its first vertex; columns and rows
};

/// The parts of a grid that have at most `maxEdge` columns and rows each, 2 or more: as few as there can be, of about
/// the same size, row by row.
std::vector<GridPart> gridParts(Vec2<std::uint32_t> size, std::uint32_t maxEdge);

/// The vertices of a part, row by row, as indices in a grid of so many columns.
std::vector<std::uint32_t> verticesOf(const GridPart& part, std::uint32_t columns);

} // namespace imgeo
