#pragma once
// Codes numbers as adaptive and raw bits. Each function encodes or decodes: a Coder is a RangeEncoder or a CostMeter,
// which code the argument, or a RangeDecoder, which ignores the argument. All return the coded value.

#include <bit>
#include <cstddef>
#include <cstdint>

namespace imgeo::compact {

/// Number of models of a number.
inline constexpr std::size_t numberModels = 32;

/// Codes a value of 0 .. 2^depth - 1 as a binary tree, with the models models + 1 .. models + 2^depth - 1.
template <typename Coder>
std::uint32_t codeTree(Coder& coder, std::size_t models, std::uint32_t depth, std::uint32_t value = 0) {
  if constexpr (requires { coder.tree(models, depth, value); })
    return coder.tree(models, depth, value);
  std::uint32_t node = 1;
  for (std::uint32_t level = depth; level-- > 0;)
    node = node << 1 | std::uint32_t{coder.bit(models + node, value >> level & 1)};
  return node - (1u << depth);
}

/// Codes the length of a number in bits, 0 .. 30.
template <typename Coder> std::uint32_t codeClass(Coder& coder, std::size_t models, std::uint32_t value = 0) {
  const std::uint32_t shortClass = codeTree(coder, models, 4, value < 15 ? value : 15);
  return shortClass < 15 ? shortClass : 15 + codeTree(coder, models + 16, 4, value - 15);
}

/// Codes a number of 0 .. 2^30 - 1.
template <typename Coder> std::uint32_t codeNumber(Coder& coder, std::size_t models, std::uint32_t value = 0) {
  const std::uint32_t length = codeClass(coder, models, static_cast<std::uint32_t>(std::bit_width(value)));
  if (length == 0)
    return 0;
  const std::uint32_t leading = 1u << (length - 1);
  return leading | coder.raw(length - 1, value & (leading - 1));
}

struct SignedNumber {
  std::int32_t value = 0;
  std::uint32_t length = 0; ///< of its absolute value, in bits: a context for the next numbers
};

/// Codes a signed number; `codeLength(length)` codes the length of its absolute value in bits and returns it.
template <typename Coder, typename CodeLength>
SignedNumber codeSignedBy(Coder& coder, std::int64_t value, CodeLength codeLength) {
  const auto magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
  const std::uint32_t length = codeLength(static_cast<std::uint32_t>(std::bit_width(magnitude)));
  if (length == 0)
    return {};
  const std::uint32_t leading = 1u << (length - 1);
  const std::uint32_t rest = coder.raw(length, (magnitude & (leading - 1)) << 1 | std::uint32_t{value < 0});
  const auto decoded = static_cast<std::int32_t>(leading | rest >> 1);
  return {rest & 1 ? -decoded : decoded, length};
}

/// Codes a number of -(2^30 - 1) .. 2^30 - 1.
template <typename Coder> SignedNumber codeSigned(Coder& coder, std::size_t models, std::int64_t value = 0) {
  return codeSignedBy(coder, value, [&](std::uint32_t length) { return codeClass(coder, models, length); });
}

/// Codes a number of -(2^30 - 1) .. 2^30 - 1 whose bit after the first has a model too, one of 32 from `nextBit` on.
template <typename Coder>
SignedNumber codeLongSigned(Coder& coder, std::size_t models, std::size_t nextBit, std::int64_t value = 0) {
  const auto magnitude = static_cast<std::uint32_t>(value < 0 ? -value : value);
  const std::uint32_t length = codeClass(coder, models, static_cast<std::uint32_t>(std::bit_width(magnitude)));
  if (length < 2) {
    if (length == 0)
      return {};
    return {coder.raw(1, std::uint32_t{value < 0}) ? -1 : 1, 1};
  }
  const std::uint32_t low = length - 2; // bits
  const std::uint32_t first = 2u | std::uint32_t{coder.bit(nextBit + length, magnitude >> low & 1)};
  const std::uint32_t rest = coder.raw(low + 1, (magnitude & ((1u << low) - 1)) << 1 | std::uint32_t{value < 0});
  const auto decoded = static_cast<std::int32_t>(first << low | rest >> 1);
  return {rest & 1 ? -decoded : decoded, length};
}

/// Codes a signed number that is mostly 0: its length is coded in unary.
template <typename Coder> SignedNumber codeSmall(Coder& coder, std::size_t models, std::int64_t value = 0) {
  return codeSignedBy(coder, value, [&](std::uint32_t length) {
    std::uint32_t i = 0;
    while (i < 30 && !coder.bit(models + i, i == length))
      ++i;
    return i;
  });
}

} // namespace imgeo::compact
