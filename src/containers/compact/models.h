#pragma once
// The probabilities of a stream's adaptive bits: docs/formats/compact.md, "Stream".
// With each bit a probability moves towards it by 1/2, 1/4, 1/4, 1/8 ... and finally 1/64 of the distance: it adapts
// fast at first, and slowly later.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace imgeo::compact {

/// The probability that a bit is 1, in 1/65536, and the number of bits coded, up to 31.
class Model {
public:
  std::uint32_t probability() const { return state_ >> 5; }

  void update(bool bit) {
    const std::uint32_t count = state_ & 31, shift = shifts[count];
    const std::uint32_t p = state_ >> 5;
    const std::uint32_t up = (65536 - p) >> shift, down = p >> shift;
    state_ = (bit ? p + up : p - down) << 5 | std::min(count + 1, 31u);
  }

private:
  /// Shift for each count.
  static constexpr std::array<std::uint8_t, 32> shifts = [] {
    std::array<std::uint8_t, 32> bits{};
    for (std::uint32_t count = 0; count < bits.size(); ++count)
      bits[count] = static_cast<std::uint8_t>(std::bit_width(count + 1));
    return bits;
  }();

  std::uint32_t state_ = 1u << 20;
};

using Models = std::vector<Model>;

} // namespace imgeo::compact
