#pragma once
// Covers triangles by paths through their dual graph, chosen so that the strip
// stitched from them is short.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Paths one behind the other. A triangle stands in a path as the side it is
/// left by, the side across which the next triangle lies; the last one as any of
/// its sides. Path i is sides[ends[i - 1] .. ends[i]), from 0 for the first.
struct StripPaths {
  std::vector<std::uint32_t> sides;
  std::vector<std::uint32_t> ends;

  std::size_t count() const { return ends.size(); }
  std::span<const std::uint32_t> path(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(sides).subspan(begin, ends[i] - begin);
  }
};

/// Every non-degenerate triangle of `corners` (three vertices below `vertexCount`
/// each) in exactly one path. `across` is oppositeHalfEdges(corners). The search is
/// random but repeatable; its time is linear in the number of triangles, and 64
/// times as long at effort 9 as at 0.
StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
                          std::size_t vertexCount, int effort);

} // namespace imgeo
