#pragma once
// What numbers of symbols.h would cost, in 1/65536 bits: the same as a CostMeter says, in a fraction of its time, since
// an encoder measures up to nine candidates for each vertex.

#include "containers/compact/range_encoder.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

namespace imgeo::compact {

/// The cost of a tree of four bits (codeTree).
inline std::uint32_t costOfFourBits(const Model* models, std::uint32_t value) {
  const std::uint32_t leaf = 16 | value;
  return costOfBit(models[1], leaf >> 3 & 1) + costOfBit(models[leaf >> 3], leaf >> 2 & 1) +
         costOfBit(models[leaf >> 2], leaf >> 1 & 1) + costOfBit(models[leaf >> 1], leaf & 1);
}

/// The cost of a number whose absolute value has `length` bits (codeLongSigned).
inline std::uint32_t costOfLongSigned(const Model* models, const Model* nextBit, std::int64_t value,
                                      std::uint32_t length) {
  const std::uint32_t raw = length << 16;
  std::uint32_t cost = raw + costOfFourBits(models, length < 15 ? length : 15);
  if (length >= 15) [[unlikely]]
    cost += costOfFourBits(models + 16, length - 15);
  if (length >= 2) {
    const auto magnitude = static_cast<std::uint32_t>(std::abs(value));
    cost += costOfBit(nextBit[length], magnitude >> (length - 2) & 1) - (1u << 16);
  }
  return cost;
}

/// The cost of a number that is mostly 0 (codeSmall).
inline std::uint32_t costOfSmall(const Model* models, std::int64_t value) {
  const auto length = static_cast<std::uint32_t>(std::bit_width(static_cast<std::uint64_t>(std::abs(value))));
  std::uint32_t cost = length << 16;
  for (std::uint32_t i = 0; i < length; ++i)
    cost += costOfBit(models[i], false);
  return length < 30 ? cost + costOfBit(models[length], true) : cost;
}

} // namespace imgeo::compact
