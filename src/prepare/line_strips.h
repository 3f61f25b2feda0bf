#pragma once
// Decomposition of lines into line strips.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// A list of line strips. Line l has the corners 2l and 2l + 1. A strip refers to each of its lines by the corner at
/// which the line begins; the line ends at the other corner, corner ^ 1, where the next line of the strip begins.
/// Strip i is corners[ends[i - 1] .. ends[i]); the first begins at 0.
struct LineStrips {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> ends;

  std::size_t count() const { return ends.size(); }
  std::span<const std::uint32_t> strip(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
};

/// Puts every line into exactly one strip, with the minimum number of strips: half the number of vertices of odd
/// degree, plus one for each connected component without such vertices. `vertices` has the vertex, below
/// `vertexCount`, of each corner; the two vertices of a line may be equal. Linear time.
LineStrips findLineStrips(std::span<const std::uint32_t> vertices, std::size_t vertexCount);

} // namespace imgeo
