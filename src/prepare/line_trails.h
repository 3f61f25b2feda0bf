#pragma once
// Lines in the order in which a pen would draw them.

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Trails one behind the other: trail i visits vertices[ends[i - 1] .. ends[i]), from
/// 0 for the first, and draws a line between each two that follow one another.
struct LineTrails {
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> ends;

  std::size_t count() const { return ends.size(); }
  std::span<const std::uint32_t> trail(std::size_t i) const {
    const std::uint32_t begin = i == 0 ? 0 : ends[i - 1];
    return std::span(vertices).subspan(begin, ends[i] - begin);
  }
};

/// Every line of `corners` (two vertices below `vertexCount` each, equal ones too)
/// in exactly one trail, in as few trails as there can be: half as many as
/// vertices where an odd number of lines end, one for each other group of
/// connected lines. Linear time.
LineTrails findLineTrails(std::span<const std::uint32_t> corners, std::size_t vertexCount);

} // namespace imgeo
