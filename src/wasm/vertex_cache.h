#pragma once
// Orders triangles so that the GPU finds most of their vertices in its cache of transformed vertices, as
// web/src/decode/compact/vertexCache.ts, which explains the order.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

/// Writes the corners of all triangles to `ordered`, an array of as many elements. `fans` are those of a CompactPatch.
/// Each triangle keeps the order of its corners.
template <typename Index>
void orderForVertexCache(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> fans, Index* ordered) {
  constexpr std::size_t ringCount = 4;
  const auto nodeCount = static_cast<std::uint32_t>(fans.size() / 2);
  std::vector<std::uint8_t> isDone(nodeCount);
  // Per ring of the column: the next node, and the end of the range of nodes.
  std::array<std::uint32_t, ringCount> next{}, end{};
  for (std::uint32_t columnStart = 0; columnStart < nodeCount; ++columnStart) {
    next[0] = columnStart;
    end[0] = columnStart + 1;
    for (std::size_t ring = 0; ring < ringCount;) { // the ring before the first is outside of the range
      const std::uint32_t node = next[ring];
      if (node == end[ring]) {
        --ring;
        continue;
      }
      next[ring] = node + 1;
      if (isDone[node])
        continue;
      isDone[node] = 1;
      const std::size_t fan = std::size_t{2} * node;
      const std::size_t first = node > 0 ? std::size_t{3} * fans[fan - 2] : 0, last = std::size_t{3} * fans[fan];
      for (std::size_t corner = first; corner < last; ++corner)
        *ordered++ = static_cast<Index>(corners[corner]);
      if (ring + 1 == ringCount)
        continue;
      ++ring;
      next[ring] = node > 0 ? fans[fan - 1] : 0;
      end[ring] = fans[fan + 1];
    }
  }
}

} // namespace imgeo::compact
