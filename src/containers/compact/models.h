#pragma once
// The probabilities of a stream's adaptive bits: docs/formats/compact.md, "Stream".
// A probability moves by 1/2, 1/4, 1/4, 1/8 ... of its distance, at last by 1/64:
// it counts what little it has seen, and then forgets slowly.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace imgeo::compact {

/// The probability that a bit is 1, in 1/65536, and how often it was asked, up to 31.
class Model {
public:
  std::uint32_t probability() const { return state_ >> 5; }

  void update(bool bit) {
    const std::uint32_t count = state_ & 31, shift = static_cast<std::uint32_t>(std::bit_width(count + 1));
    std::uint32_t p = state_ >> 5;
    if (bit)
      p += (65536 - p) >> shift;
    else
      p -= p >> shift;
    state_ = p << 5 | std::min(count + 1, 31u);
  }

private:
  std::uint32_t state_ = 1u << 20;
};

using Models = std::vector<Model>;

} // namespace imgeo::compact
