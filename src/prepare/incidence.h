#pragma once
// Vertex-to-corner incidence: the inverse of a corner -> vertex array, in compressed sparse row form.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// The corners of vertex v, ascending, are corners[offsets[v] .. offsets[v + 1]).
struct Incidence {
  std::vector<std::uint32_t> offsets, corners;

  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(corners).subspan(offsets[vertex], offsets[vertex + 1] - offsets[vertex]);
  }
};

/// `vertexOf(corner)` returns the vertex, below `vertexCount`, of each of `cornerCount` corners.
template <typename VertexOf>
Incidence incidenceOf(std::size_t cornerCount, std::size_t vertexCount, VertexOf vertexOf) {
  Incidence incidence;
  incidence.offsets.assign(vertexCount + 1, 0);
  incidence.corners.resize(cornerCount);
  for (std::size_t corner = 0; corner < cornerCount; ++corner)
    ++incidence.offsets[vertexOf(corner)];
  std::uint32_t end = 0;
  for (std::uint32_t& offset : incidence.offsets)
    offset = end += offset;
  // Filling from the back turns the end of each range into its beginning, and leaves the corners ascending.
  for (std::size_t corner = cornerCount; corner-- > 0;)
    incidence.corners[--incidence.offsets[vertexOf(corner)]] = static_cast<std::uint32_t>(corner);
  return incidence;
}

} // namespace imgeo
