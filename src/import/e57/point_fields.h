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

/// Records of a scan that follow one another.
struct RecordRange {
  std::uint64_t first = 0, count = 0;
  std::uint64_t end() const { return first + count; }
};

/// What is known of a bytestream between two of its pieces.
struct FieldState {
  std::uint64_t decoded = 0;  ///< values before
  Bytes pending{};            ///< bytes that are not decoded
  std::uint32_t firstBit = 0; ///< of pending[0], 0 .. 7
};

/// The values of one field, appended as pieces of its bytestream arrive.
class FieldValues {
public:
  /// `field` outlives it. `range`: the records whose values are kept; the caller has compared it with the size of the
  /// file. `isNarrow`: whether they are rounded to single precision; values beyond it become infinite. `state`: of the
  /// bytestream where the next piece begins.
  FieldValues(const Field& field, RecordRange range, bool isNarrow, FieldState state = {});

  /// Decodes what the piece completes, up to the last record. What is behind it is ignored.
  void append(ByteSpan piece);
  std::uint64_t decoded() const { return state_.decoded; } ///< values from the first record of the scan on
  bool isComplete() const { return state_.decoded >= range_.end(); }

  const std::vector<double>& wide() const { return wide_; }
  std::vector<float>& narrow() { return narrow_; }

private:
  void add(double value);

  const Field& field_;
  RecordRange range_;
  bool isNarrow_;
  FieldState state_;
  std::vector<double> wide_;
  std::vector<float> narrow_;
};

} // namespace imgeo::e57
