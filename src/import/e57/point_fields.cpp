#include "import/e57/point_fields.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace imgeo::e57 {

namespace {

/// Bytes behind the last one that a load of 64 bits and a following byte may touch.
constexpr std::size_t paddingBytes = 9;

std::uint64_t bitsAt(const Bytes& bytes, std::uint64_t bit, std::uint32_t count) {
  const std::uint8_t* const at = bytes.data() + bit / 8;
  const auto shift = static_cast<std::uint32_t>(bit % 8);
  std::uint64_t value = loadLittle<std::uint64_t>(at) >> shift;
  if (shift + count > 64)
    value |= std::uint64_t{at[8]} << (64 - shift);
  return count == 64 ? value : value & ((std::uint64_t{1} << count) - 1);
}

} // namespace

std::uint32_t Field::bits() const {
  switch (type) {
  case Type::float32:
    return 32;
  case Type::float64:
    return 64;
  case Type::integer:
    return static_cast<std::uint32_t>(std::bit_width(range));
  case Type::text:
    return 8;
  }
  return 0;
}

double Field::valueOf(std::uint64_t stored) const {
  switch (type) {
  case Type::float32:
    return std::bit_cast<float>(static_cast<std::uint32_t>(stored));
  case Type::float64:
    return std::bit_cast<double>(stored);
  case Type::integer: // the sum is one of 64 bits with a sign, also where the difference is not
    return static_cast<double>(static_cast<std::int64_t>(static_cast<std::uint64_t>(minimum) + stored)) * scale +
           addend;
  case Type::text:
    break;
  }
  return 0;
}

FieldValues::FieldValues(const Field& field, RecordRange range, bool isNarrow, FieldState state)
    : field_(field), range_(range), isNarrow_(isNarrow), state_(std::move(state)) {
  if (isNarrow_)
    narrow_.reserve(range.count);
  else
    wide_.reserve(range.count);
  if (field.bits() != 0)
    return;
  state_.decoded = range.first;
  while (!isComplete())
    add(field.valueOf(0));
}

void FieldValues::add(double value) {
  if (state_.decoded++ < range_.first)
    return;
  if (isNarrow_)
    narrow_.push_back(static_cast<float>(value));
  else
    wide_.push_back(value);
}

void FieldValues::append(ByteSpan piece) {
  const std::uint32_t bits = field_.bits();
  if (bits == 0 || isComplete())
    return;
  Bytes& pending = state_.pending;
  pending.insert(pending.end(), piece.begin(), piece.end());
  const std::uint64_t lastBit = std::uint64_t{pending.size()} * 8;
  pending.resize(pending.size() + paddingBytes);
  std::uint64_t bit = state_.firstBit;
  for (; lastBit - bit >= bits && !isComplete(); bit += bits)
    add(field_.valueOf(bitsAt(pending, bit, bits)));
  pending.resize(pending.size() - paddingBytes);
  pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(bit / 8));
  state_.firstBit = static_cast<std::uint32_t>(bit % 8);
}

} // namespace imgeo::e57
