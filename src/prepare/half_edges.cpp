#include "prepare/half_edges.h"

#include "prepare/index_hash_table.h"

#include <algorithm>

namespace imgeo {

std::vector<std::uint32_t> oppositeHalfEdges(std::span<const std::uint32_t> corners) {
  const auto from = [&](std::uint32_t halfEdge) { return corners[halfEdge]; };
  const auto to = [&](std::uint32_t halfEdge) { return corners[nextHalfEdge(halfEdge)]; };
  const auto keyOf = [&](std::uint32_t halfEdge) {
    return std::uint64_t{std::min(from(halfEdge), to(halfEdge))} << 32 | std::max(from(halfEdge), to(halfEdge));
  };

  std::vector<std::uint32_t> opposites(corners.size(), noHalfEdge);
  // By edge, which is identified by its first half-edge: a linked list of the half-edges without an opposite so far.
  // All of them have the same direction.
  std::vector<std::uint32_t> unpaired(corners.size(), noHalfEdge), nextUnpaired(corners.size(), noHalfEdge);
  IndexHashTable edges(corners.size());
  for (std::uint32_t halfEdge = 0; halfEdge < corners.size(); ++halfEdge) {
    const std::uint32_t* triangle = &corners[halfEdge - halfEdge % 3];
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0])
      continue;
    const std::uint64_t key = keyOf(halfEdge);
    const std::uint32_t edge =
        edges.findOrInsert(mixHash(0, key), halfEdge, [&](std::uint32_t other) { return keyOf(other) == key; });
    const std::uint32_t other = unpaired[edge];
    if (other != noHalfEdge && from(other) == to(halfEdge)) {
      unpaired[edge] = nextUnpaired[other];
      opposites[halfEdge] = other;
      opposites[other] = halfEdge;
    } else {
      nextUnpaired[halfEdge] = other;
      unpaired[edge] = halfEdge;
    }
  }
  return opposites;
}

} // namespace imgeo
