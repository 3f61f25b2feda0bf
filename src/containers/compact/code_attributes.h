#pragma once
// What the coding of all attributes shares: docs/formats/compact.md, "Attributes".

#include "containers/compact/compact_patch.h"
#include "containers/compact/prediction.h"
#include "containers/compact/symbols.h"
#include "containers/compact/wedges.h"

namespace imgeo::compact {

/// The first model of each symbol in the stream of an attribute.
namespace attributeModels {
inline constexpr std::size_t repeat = 0, choice = repeat + 1, exact = choice + 24, flip = exact + 2, first = flip + 1,
                             second = first + numberModels, count = second + 93 * numberModels;
}

/// The data from which attributes are predicted.
struct Surface {
  Topology topology;
  const Connectivity& connectivity;
  const Wedges& wedges;
  const std::vector<Vec3u>& positions;
  const NormalSums& normalSums; ///< per vertex; triangles only
  std::uint32_t normalShift;
  bool isBase;

  bool hasSeams() const { return wedges.count() > positions.size(); }
};

/// Codes for each wedge whether it repeats the value of the previous wedge of its vertex.
template <typename Coder>
std::vector<bool> codeRepeats(Coder& coder, const Surface& surface, const std::vector<Value>& values) {
  const Wedges& wedges = surface.wedges;
  std::vector<bool> repeats(wedges.count());
  for (std::uint32_t wedge = 0; wedge < wedges.count(); ++wedge)
    if (const std::uint32_t previous = wedges.previous[wedge]; previous != none)
      repeats[wedge] = coder.bit(attributeModels::repeat, Coder::encodes && values[wedge] == values[previous]);
  return repeats;
}

} // namespace imgeo::compact
