#pragma once
// The order in which the triangles (or lines) and vertices of a patch are coded, and the adjacency that later passes
// use for prediction.

#include "containers/compact/range_decoder.h"
#include "containers/compact/range_encoder.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

inline constexpr std::uint32_t none = UINT32_MAX;

/// The next and the previous corner of the same triangle.
inline std::uint32_t after(std::uint32_t corner) {
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}
inline std::uint32_t before(std::uint32_t corner) {
  return corner % 3 == 0 ? corner + 2 : corner - 1;
}

struct Connectivity {
  std::vector<std::uint32_t> vertex; ///< per corner
  std::uint32_t vertexCount = 0;

  // Triangles only; `none`: there is no such corner or vertex.
  std::vector<std::uint32_t> across;  ///< per triangle: the corner opposite its first edge in the neighbour
  std::vector<std::uint32_t> closing; ///< per triangle: the same for its second edge on the boundary, if it has one
  std::vector<std::uint32_t> ahead;   ///< per vertex: the next vertex on the boundary when it was introduced
  std::vector<std::uint32_t> behind;  ///< per vertex: the previous vertex on the boundary at that time
  std::vector<std::uint32_t> second;  ///< per vertex: the corner opposite the edge of a second parallelogram

  /// Triangles only; decoders only: for each node of the boundary, in the order of creation, the numbers of triangles
  /// and of nodes when all triangles around it were decoded.
  std::vector<std::uint32_t> fans;

  std::vector<std::uint32_t> from; ///< lines only, per vertex: the other end of the line that introduced it
};

/// Number of models of the connectivity stream.
extern const std::size_t connectivityModels;

Connectivity decodeTriangles(RangeDecoder& decoder, std::uint32_t triangleCount, std::uint32_t vertexCount);
Connectivity decodeLines(RangeDecoder& decoder, std::uint32_t lineCount, std::uint32_t vertexCount);

/// Chooses an order of triangles over vertices 0 .. vertexCount - 1, all of which are used, and encodes it.
/// `sourceCorner` receives the index in `vertices` of each corner of the result. The order begins with `firstTriangle`.
Connectivity encodeTriangles(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount,
                             std::uint32_t firstTriangle, std::vector<std::uint32_t>& sourceCorner);
/// Encodes lines in their order and direction.
Connectivity encodeLines(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount);

} // namespace imgeo::compact
