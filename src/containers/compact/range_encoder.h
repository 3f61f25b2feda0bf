#pragma once
// Writes adaptive bits from the front of a stream and raw bits from its back. The coder is that of Martin, "Range
// encoding", 1979, binary and with carries; the two ends are as in Opus (RFC 6716).

#include "base/bytes.h"
#include "containers/compact/models.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>

namespace imgeo::compact {

class RangeEncoder {
public:
  static constexpr bool encodes = true;

  explicit RangeEncoder(std::size_t modelCount) : models_(modelCount) {}

  const Models& models() const { return models_; }

  /// Writes a bit and returns it.
  bool bit(std::size_t model, bool value) {
    interval_.narrow(models_[model], value);
    if (interval_.waiting >= maxWaiting)
      flush();
    return value;
  }

  /// Writes a tree of bits as codeTree does, with the state in registers.
  std::uint32_t tree(std::size_t models, std::uint32_t depth, std::uint32_t value) {
    const std::uint32_t leaf = 1u << depth | value;
    Interval interval = interval_;
    for (std::uint32_t level = depth; level-- > 0;) {
      interval.narrow(models_[models + (leaf >> (level + 1))], leaf >> level & 1);
      if (interval.waiting >= maxWaiting) {
        interval_ = interval;
        flush();
        interval = interval_;
      }
    }
    interval_ = interval;
    return value;
  }

  /// Writes the `count` (0 .. 30) lowest bits of a value and returns it.
  std::uint32_t raw(std::uint32_t count, std::uint32_t value) {
    assert(count <= 30 && value >> count == 0);
    rawBits_ |= std::uint64_t{value} << rawBitCount_;
    rawBitCount_ += count;
    if (rawBitCount_ >= 32)
      for (int i = 0; i < 4; ++i)
        shiftOutRaw();
    return value;
  }

  /// Asserts what decoders require.
  void require(bool condition, const char*) const { assert(condition), (void)condition; }

  Bytes finish() {
    flush();
    interval_ = {interval_.low << 24, 0, 24}; // the rest of the interval
    flush();
    while (rawBitCount_ > 0)
      shiftOutRaw();
    front_.insert(front_.end(), back_.rbegin(), back_.rend());
    return std::move(front_);
  }

private:
  /// The state of the coder. Several bytes are written at a time: branches on each bit, or on the number of bytes that
  /// it moves, would be mispredicted.
  struct Interval {
    std::uint64_t low = 0; ///< 24 bits, above them the bits that wait, above those a carry
    std::uint32_t range = 0xffffff;
    std::uint32_t waiting = 0; ///< bits

    void narrow(Model& model, bool value) {
      const std::uint32_t bound = (range >> 8) * model.probability() >> 8;
      model.update(value);
      const std::uint32_t isOne = -std::uint32_t{value}; // all bits or none
      low += bound & ~isOne;
      range = (bound & isOne) | ((range - bound) & ~isOne);
      shift(8 * std::uint32_t{range < 65536});
      if (range < 65536) [[unlikely]]
        shift(8);
    }
    void shift(std::uint32_t bits) {
      range <<= bits;
      low <<= bits;
      waiting += bits;
    }
  };
  /// A bit moves at most two bytes, since no probability is near 0: low has 24 + 16 + 16 bits and a carry.
  static constexpr std::uint32_t maxWaiting = 24;

  /// Writes the waiting bytes.
  void flush() {
    if (interval_.low >> (24 + interval_.waiting))
      carry();
    for (; interval_.waiting > 0; interval_.waiting -= 8)
      front_.push_back(static_cast<std::uint8_t>(interval_.low >> (16 + interval_.waiting)));
    interval_.low &= 0xffffff;
  }

  void carry() {
    auto digit = front_.rbegin();
    for (; *digit == 0xff; ++digit)
      *digit = 0;
    ++*digit;
  }

  void shiftOutRaw() {
    back_.push_back(static_cast<std::uint8_t>(rawBits_));
    rawBits_ >>= 8;
    rawBitCount_ -= std::min(rawBitCount_, 8u);
  }

  Models models_;
  Bytes front_, back_;
  Interval interval_;
  std::uint64_t rawBits_ = 0;
  std::uint32_t rawBitCount_ = 0;
};

/// The binary logarithm of a number of up to 31 bits, in 1/65536. Each bit of the fraction is 1 if the square of the
/// rest reaches 2.
constexpr std::uint32_t binaryLogarithm(std::uint32_t number) {
  const auto whole = static_cast<std::uint32_t>(std::bit_width(number)) - 1;
  std::uint64_t left = std::uint64_t{number} << (31 - whole); // 1 .. 2, in 1/2^31
  std::uint32_t logarithm = whole;
  for (int bit = 0; bit < 16; ++bit) {
    left = left * left >> 31;
    const std::uint32_t reachesTwo = left >> 32 & 1;
    left >>= reachesTwo;
    logarithm = logarithm << 1 | reachesTwo;
  }
  return logarithm;
}

/// The cost, in 1/65536 bits, of a bit whose probability is between i and i + 1 of 4096.
inline constexpr std::array<std::uint32_t, 4096> costsOfProbabilities = [] {
  std::array<std::uint32_t, 4096> costs{};
  for (std::uint32_t i = 0; i < costs.size(); ++i)
    costs[i] = (13 << 16) - binaryLogarithm(2 * i + 1);
  return costs;
}();

/// The cost of a bit, in 1/65536 bits.
inline std::uint32_t costOfBit(const Model& model, bool value) {
  const std::uint32_t probability = value ? model.probability() : 65536 - model.probability();
  assert(probability < 65536); // no model reaches certainty
  return costsOfProbabilities[probability >> 4];
}

/// Measures the cost of bits, in 1/65536 bits, without writing them.
class CostMeter {
public:
  static constexpr bool encodes = true;

  /// Measuring may stop at a cost of `limit`.
  explicit CostMeter(const RangeEncoder& encoder, std::uint32_t limit) : models_(encoder.models()), limit_(limit) {}

  std::uint32_t cost() const { return cost_; }
  bool isSpent() const { return cost_ >= limit_; }

  bool bit(std::size_t model, bool value) {
    cost_ += costOfBit(models_[model], value);
    return value;
  }
  /// The cost of a tree of bits; most costs that encoders measure are trees.
  std::uint32_t tree(std::size_t models, std::uint32_t depth, std::uint32_t value) {
    const std::uint32_t leaf = 1u << depth | value;
    for (std::uint32_t level = depth; level-- > 0;)
      cost_ += costOfBit(models_[models + (leaf >> (level + 1))], leaf >> level & 1);
    return value;
  }
  std::uint32_t raw(std::uint32_t count, std::uint32_t value) {
    cost_ += count << 16;
    return value;
  }
  void require(bool, const char*) const {}

private:
  const Models& models_;
  std::uint32_t limit_, cost_ = 0;
};

} // namespace imgeo::compact
