#pragma once
// The fields of the points of an E57 scan, and their values from the bytestreams of data packets (ASTM E2807, 8.3 and
// 9.7): floats, and integers of as many bits as their range needs, the lowest first, without gaps.

#include "base/bytes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::e57 {

struct Field {
  enum class Type : std::uint8_t { float32, float64, integer, text };

  std::string name;             ///< of its element: "cartesianX"
  Type type = Type::float64;    ///< ScaledIntegers are integers with a scale
  std::int64_t minimum = 0;     ///< of integers, which are stored as differences to it
  std::uint64_t range = 0;      ///< largest stored difference
  double scale = 1, addend = 0; ///< value = integer * scale + addend

  /// Bits of a stored value, 0 .. 64; of texts, whose lengths differ, 8, which is the least of them.
  std::uint32_t bits() const;
  /// The value of a stored number; may be infinite or NaN.
  double valueOf(std::uint64_t stored) const;
};

/// The values of one field, appended as pieces of its bytestream arrive.
class FieldValues {
public:
  /// `field` outlives it. `count`: values of all records; the caller has compared it with the size of the file.
  /// `isNarrow`: whether they are rounded to single precision; values beyond it become infinite.
  FieldValues(const Field& field, std::uint64_t count, bool isNarrow);

  /// Decodes what the piece completes, up to the number of records. What is behind it is ignored.
  void append(ByteSpan piece);
  std::uint64_t size() const { return isNarrow_ ? narrow_.size() : wide_.size(); }
  bool isComplete() const { return size() == count_; }

  const std::vector<double>& wide() const { return wide_; }
  std::vector<float>& narrow() { return narrow_; }

private:
  void add(double value);

  const Field& field_;
  std::uint64_t count_;
  bool isNarrow_;
  Bytes pending_;              ///< bytes that are not decoded
  std::uint32_t firstBit_ = 0; ///< of pending_[0], 0 .. 7
  std::vector<double> wide_;
  std::vector<float> narrow_;
};

} // namespace imgeo::e57
