#pragma once
// Encodes and decodes the segment of each triangle of a base: docs/formats/compact.md, "Base".

#include "containers/compact/connectivity.h"
#include "containers/compact/symbols.h"

namespace imgeo::compact {

/// The first model of each symbol in the stream.
namespace segmentModels {
inline constexpr std::size_t same = 0, other = same + 4, segment = other + 4, count = segment + numberModels;
}

struct Segments {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<bool> isShared; ///< per vertex: several segments have it
};

/// `segments` has an element for each triangle in coded order; decoders fill it.
template <typename Coder>
Segments codeSegments(Coder& coder, const Connectivity& connectivity, std::uint32_t segmentCount,
                      std::vector<std::uint32_t> segments) {
  std::vector<std::uint32_t> latest(connectivity.vertexCount, none);
  std::vector<bool> isShared(connectivity.vertexCount);
  for (std::size_t triangle = 0; triangle < segments.size(); ++triangle) {
    const std::uint32_t* vertices = &connectivity.vertex[3 * triangle];
    const std::uint32_t across = connectivity.across[triangle];
    const std::uint32_t guess = across != none ? segments[across / 3] : triangle > 0 ? segments[triangle - 1] : 0;
    std::uint32_t other = none;
    std::size_t differing = 0;
    for (const std::uint32_t vertex : {vertices[2], vertices[1], vertices[0]}) {
      const std::uint32_t there = latest[vertex];
      if (there == none || there == guess)
        continue;
      ++differing;
      if (other == none)
        other = there;
    }
    std::uint32_t& segment = segments[triangle];
    const std::uint32_t source = segment; // meaningful for encoders only
    if (coder.bit(segmentModels::same + differing, source == guess)) {
      segment = guess;
    } else if (other != none && coder.bit(segmentModels::other + differing, source == other)) {
      segment = other;
    } else {
      segment = codeNumber(coder, segmentModels::segment, source);
      coder.require(segment < segmentCount, "a triangle names a segment that does not exist");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = vertices[i];
      if (latest[vertex] != none && latest[vertex] != segment)
        isShared[vertex] = true;
      latest[vertex] = segment;
    }
  }
  return {std::move(segments), std::move(isShared)};
}

} // namespace imgeo::compact
