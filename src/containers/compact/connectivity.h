#pragma once
// The order in which a patch's triangles (or lines) and vertices come, and what
// the passes after it want to know of that order.

#include "containers/compact/range_decoder.h"
#include "containers/compact/range_encoder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

inline constexpr std::uint32_t none = UINT32_MAX;

/// The corners of a corner's triangle after and before it, in its orientation.
inline std::uint32_t after(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline std::uint32_t before(std::uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

struct Connectivity {
  std::vector<std::uint32_t> vertex; ///< per corner
  std::uint32_t vertexCount = 0;

  // Triangles. `none` where there is no such thing.
  std::vector<std::uint32_t> across;  ///< per triangle: the corner opposite of its first edge in the neighbour there
  std::vector<std::uint32_t> closing; ///< per triangle: the same for the second edge that it closes
  std::vector<std::uint32_t> ahead;   ///< per vertex: the boundary's next vertex when it came
  std::vector<std::uint32_t> behind;  ///< per vertex: the one before, likewise
  std::vector<std::uint32_t> second;  ///< per vertex: the corner opposite of the edge on its other side

  std::vector<std::uint32_t> from; ///< lines, per vertex: the other end of the line that brought it
};

/// Models of the stream of connectivity.
extern const std::size_t connectivityModels;

Connectivity decodeTriangles(RangeDecoder& decoder, std::uint32_t triangleCount, std::uint32_t vertexCount);
Connectivity decodeLines(RangeDecoder& decoder, std::uint32_t lineCount, std::uint32_t vertexCount);

/// Finds an order for elements over vertices 0 .. vertexCount - 1, all of them in use,
/// and writes it. `sourceCorner` receives the corner of `vertices` that each
/// corner of the result is. `firstTriangle` is where it begins.
Connectivity encodeTriangles(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount,
                             std::uint32_t firstTriangle, std::vector<std::uint32_t>& sourceCorner);
/// The same for lines, in the order in which they stand and in their direction.
Connectivity encodeLines(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount);

} // namespace imgeo::compact
