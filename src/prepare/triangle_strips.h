#pragma once
// Triangle strips: paths through the dual graph, joined into one strip.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct TriangleStrips {
  std::vector<std::uint32_t> strip;     ///< vertices of one strip
  std::vector<std::uint32_t> triangles; ///< separate triangles, three vertices each
};

/// Makes a strip of the non-degenerate triangles of `corners` (three vertices below `vertexCount` each). Together, the
/// strip and the separate triangles draw each of them as often as `corners` has it, in its orientation; all other
/// triangles of the strip are degenerate. Triangles that would lengthen the strip by more than three indices each are
/// separate if there are enough of them to be worth a draw of their own. Neighbours in `corners` stay close to each
/// other. Effort: 0 (fastest) .. 9 (fewest indices).
TriangleStrips makeTriangleStrips(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort);

} // namespace imgeo
