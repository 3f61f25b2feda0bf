#pragma once
// Half-edges of a triangle list and their opposites: the adjacency of triangles.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace imgeo {

/// Half-edge 3t + s of triangle t runs from its corner s to its corner (s + 1) mod 3.
inline std::uint32_t nextHalfEdge(std::uint32_t halfEdge) {
  return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1;
}
inline std::uint32_t previousHalfEdge(std::uint32_t halfEdge) {
  return halfEdge % 3 == 0 ? halfEdge + 2 : halfEdge - 1;
}

inline constexpr std::uint32_t noHalfEdge = std::numeric_limits<std::uint32_t>::max();

/// The opposite (twin) of each half-edge: the same edge in the other direction, in another triangle, or `noHalfEdge`.
/// A half-edge has at most one opposite; where more than two triangles share an edge, half-edges of opposite
/// direction are paired in the order of the list. Degenerate triangles have no neighbours. Linear time.
std::vector<std::uint32_t> oppositeHalfEdges(std::span<const std::uint32_t> corners);

} // namespace imgeo
