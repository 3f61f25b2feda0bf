#pragma once
// Triangle strips: paths through the dual graph, stitched into one strip.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct Strips {
  std::vector<std::uint32_t> strip;     ///< one strip
  std::vector<std::uint32_t> triangles; ///< separate ones, three vertices each
};

/// Draws every non-degenerate triangle of `corners` (three vertices below `vertexCount`
/// each) as often as it is there, in its orientation, and else only degenerate ones.
/// Triangles that would lengthen the strip by more than three indices each are
/// separate, where there are enough of them to be worth a draw of their own.
/// Neighbours in `corners` come near each other. Effort: 0 fastest .. 9 fewest indices.
Strips makeStrips(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort);

} // namespace imgeo
