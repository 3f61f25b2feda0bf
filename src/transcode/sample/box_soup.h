#pragma once
// A generated soup of boxes as building models have them: rooms of slabs, walls, columns and small parts.

#include "base/vec.h"

#include <cstdint>

namespace imgeo {

/// Boxes that are computed one by one from their number, in metres, with z up and edges along the axes. Boxes of
/// different rooms do not touch. They do not depend on the machine.
class BoxSoup {
public:
  /// `count` is 1 .. maxCount. Another seed gives other small parts.
  BoxSoup(std::uint64_t count, std::uint64_t seed);

  static constexpr std::uint64_t boxesPerRoom = 200;
  /// Whose vertices 32 bits can number.
  static constexpr std::uint64_t maxCount = 500'000'000;

  /// A box, 0 .. count - 1: from slabs of 5.9 m to parts of a centimetre. Boxes of a room follow one another, and rooms
  /// of a storey. Gaps between rooms are 0.05 m at least, more than single precision rounds.
  Box3d box(std::uint64_t number) const;

private:
  std::uint64_t side_ = 1; ///< rooms along each side of a storey
  std::uint64_t seed_;
};

} // namespace imgeo
