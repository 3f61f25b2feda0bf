#pragma once
// Triangle strips: paths through the dual graph, stitched into one strip.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// One triangle strip over `corners` (three vertices below `vertexCount` a
/// triangle) that draws every non-degenerate triangle as often as it is there,
/// in its orientation, and else only degenerate ones. Neighbours in `corners`
/// come near each other in the strip.
std::vector<std::uint32_t> stitchedStrip(std::span<const std::uint32_t> corners, std::size_t vertexCount);

} // namespace imgeo
