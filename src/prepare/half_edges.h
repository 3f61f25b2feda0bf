#pragma once
// Which triangles are neighbours: the dual graph of a triangle list.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace imgeo {

/// Side 3t + s of triangle t runs from its corner s to its corner s + 1; the
/// corner s + 2 is opposite.
inline std::uint32_t nextHalfEdge(std::uint32_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}
inline std::uint32_t previousHalfEdge(std::uint32_t side) {
  return side % 3 == 0 ? side + 2 : side - 1;
}

inline constexpr std::uint32_t noHalfEdge = std::numeric_limits<std::uint32_t>::max();

/// The side across each side: the same edge run through the other way by
/// another triangle, or `noHalfEdge`. Sides are paired at most once; where more than
/// two triangles meet at an edge, those of opposite direction are paired as
/// they come. Degenerate triangles have no neighbours. Linear time.
std::vector<std::uint32_t> oppositeHalfEdges(std::span<const std::uint32_t> corners);

} // namespace imgeo
