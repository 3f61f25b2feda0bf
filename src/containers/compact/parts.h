#pragma once
// Which part of a base each triangle belongs to: docs/formats/compact.md, "Parts".

#include "containers/compact/connectivity.h"
#include "containers/compact/symbols.h"

namespace imgeo::compact {

namespace partModels {
inline constexpr std::size_t same = 0, other = same + 4, part = other + 4, count = part + numberModels;
}

struct Parts {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<bool> isShared; ///< per vertex: several parts have it
};

/// `parts` are those of an encoder's triangles, in their coded order, or room for a decoder's.
template <typename Coder>
Parts codeParts(Coder& coder, const Connectivity& connectivity, std::uint32_t partCount,
                std::vector<std::uint32_t> parts) {
  std::vector<std::uint32_t> latest(connectivity.vertexCount, none);
  std::vector<bool> isShared(connectivity.vertexCount);
  for (std::size_t triangle = 0; triangle < parts.size(); ++triangle) {
    const std::uint32_t* vertices = &connectivity.vertex[3 * triangle];
    const std::uint32_t across = connectivity.across[triangle];
    const std::uint32_t guess = across != none ? parts[across / 3] : triangle > 0 ? parts[triangle - 1] : 0;
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
    std::uint32_t& part = parts[triangle];
    const std::uint32_t wanted = part;
    if (coder.bit(partModels::same + differing, wanted == guess)) {
      part = guess;
    } else if (other != none && coder.bit(partModels::other + differing, wanted == other)) {
      part = other;
    } else {
      part = codeNumber(coder, partModels::part, wanted);
      coder.require(part < partCount, "a triangle belongs to a part that there is not");
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t vertex = vertices[i];
      if (latest[vertex] != none && latest[vertex] != part)
        isShared[vertex] = true;
      latest[vertex] = part;
    }
  }
  return {std::move(parts), std::move(isShared)};
}

} // namespace imgeo::compact
