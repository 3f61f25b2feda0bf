#pragma once
// A path cover of the dual graph of a triangle list, optimised for a short triangle strip.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// A list of paths. A path names each of its triangles by the half-edge through which it leads to the next triangle,
/// and the last triangle by any of its half-edges. Path i is halfEdges[ends[i - 1] .. ends[i]); the first begins at 0.
struct StripPaths {
  std::vector<std::uint32_t> halfEdges;
  std::vector<std::uint32_t> ends;

  std::size_t count() const { return ends.size(); }
  std::span<const std::uint32_t> path(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(halfEdges).subspan(begin, ends[i] - begin);
  }
};

/// Puts every non-degenerate triangle of `corners` (three vertices below `vertexCount` each) into exactly one path.
/// `opposites` is oppositeHalfEdges(corners). The search is randomised but repeatable. Its time is linear in the number
/// of triangles, and 64 times as long at effort 9 as at effort 0.
StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> opposites,
                          std::size_t vertexCount, int effort);

} // namespace imgeo
