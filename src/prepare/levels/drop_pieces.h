#pragma once
// Leaves whole connected pieces out of a simplified group: pieces of a few triangles, such as boxes, have no coarser
// form of their own.

#include "base/disjoint_sets.h"
#include "prepare/simplify.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// The connected pieces of triangles, whose corners are positions, as sets of positions.
DisjointSets piecesOf(std::size_t positionCount, std::span<const std::uint32_t> corners);

/// The number of connected pieces of triangles, whose corners are positions.
std::size_t countPieces(std::size_t positionCount, std::span<const std::uint32_t> corners);

/// Leaves out pieces without fixed positions until about `triangleCount` triangles remain, or no such piece: those with
/// the shortest diagonals first, by quarters of powers of two, and of one quarter so many that the others are spread
/// evenly. The piece with the longest diagonal stays. `isFixed` is by position of `simplified`; its entries are moved
/// along. Deterministic.
void dropPieces(SimplifiedTriangles& simplified, std::vector<bool>& isFixed, std::size_t triangleCount);

} // namespace imgeo
