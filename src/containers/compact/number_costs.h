#pragma once
// What numbers of symbols.h would cost, in 1/65536 bits: the same as a CostMeter says, in a fraction of its time.

#include "containers/compact/range_encoder.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace imgeo::compact {

/// The cost of a number that is mostly 0 (codeSmall).
inline std::uint32_t costOfSmall(const Model* models, std::int64_t value) {
  const auto length = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint64_t>(std::abs(value))));
  std::uint32_t cost = length << 16;
  for (std::uint32_t i = 0; i < length; ++i)
    cost += costOfBit(models[i], false);
  return length < 30 ? cost + costOfBit(models[length], true) : cost;
}

} // namespace imgeo::compact
