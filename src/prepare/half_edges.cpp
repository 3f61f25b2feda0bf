#include "prepare/half_edges.h"

#include "prepare/index_hash_table.h"

#include <algorithm>

namespace imgeo {

std::vector<std::uint32_t> oppositeHalfEdges(std::span<const std::uint32_t> corners) {
  const auto from = [&](std::uint32_t side) { return corners[side]; };
  const auto to = [&](std::uint32_t side) { return corners[nextHalfEdge(side)]; };
  const auto keyOf = [&](std::uint32_t side) {
    return std::uint64_t{std::min(from(side), to(side))} << 32 | std::max(from(side), to(side));
  };

  std::vector<std::uint32_t> across(corners.size(), noHalfEdge);
  // Of each edge, the sides that wait for their opposite; they all have one
  // direction. The edge is named by the first side that ran along it.
  std::vector<std::uint32_t> waiting(corners.size(), noHalfEdge), nextWaiting(corners.size(), noHalfEdge);
  IndexHashTable edges(corners.size());
  for (std::uint32_t side = 0; side < corners.size(); ++side) {
    const std::uint32_t* triangle = &corners[side - side % 3];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    const std::uint64_t key = keyOf(side);
    const std::uint32_t edge =
        edges.findOrInsert(mixHash(0, key), side, [&](std::uint32_t other) { return keyOf(other) == key; });
    const std::uint32_t other = waiting[edge];
    if (other != noHalfEdge && from(other) == to(side)) {
      waiting[edge] = nextWaiting[other];
      across[side] = other;
      across[other] = side;
    } else {
      nextWaiting[side] = other;
      waiting[edge] = side;
    }
  }
  return across;
}

} // namespace imgeo
