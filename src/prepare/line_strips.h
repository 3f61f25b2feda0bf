#pragma once
// Lines in the order in which a pen would draw them.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// LineStrips one behind the other. Line l has the corners 2l and 2l + 1; it stands in a
/// trail as the corner that is walked from, and the other one, corner ^ 1, is at the
/// vertex that the next line begins at. Trail i is corners[ends[i - 1] .. ends[i]),
/// from 0 for the first.
struct LineStrips {
  std::vector<std::uint32_t> corners;
  std::vector<std::uint32_t> ends;

  std::size_t count() const { return ends.size(); }
  std::span<const std::uint32_t> trail(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(corners).subspan(begin, ends[i] - begin);
  }
};

/// Every line of `vertices` (the vertex of each corner, below `vertexCount`; the two
/// of a line may be equal) in exactly one trail, in as few trails as there can be: half as
/// many as vertices where an odd number of lines end, one for each other group of
/// connected lines. Linear time.
LineStrips findLineStrips(std::span<const std::uint32_t> vertices, std::size_t vertexCount);

} // namespace imgeo
