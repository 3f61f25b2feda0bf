#pragma once
// The header of a LAS file, and the variable length records between header and points.

#include "base/bytes.h"
#include "base/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace imgeo::las {

/// A number of each point, where its record holds it.
struct Dimension {
  enum class Type : std::uint8_t { uint8, int8, uint16, int16, uint32, int32, uint64, int64, float32, float64 };

  std::string name; ///< without spaces and commas
  Type type = Type::uint8;
  std::size_t offset = 0;       ///< in the record
  std::uint32_t components = 1; ///< 1..3, one after the other
  std::uint32_t shift = 0;      ///< of the bits of a uint8
  std::uint32_t mask = 0xff;    ///< after the shift
  double scale = 1, addend = 0; ///< of each component

  /// The value of a component; may be infinite or NaN.
  double valueOf(const std::uint8_t* record, std::uint32_t component) const;
};

struct Header {
  std::uint64_t pointCount = 0;      ///< 1 .. 2^32 - 1; all records are in the file
  std::uint32_t firstPoint = 0;      ///< offset of the first record in bytes
  std::uint16_t recordBytes = 0;     ///< at least the bytes of the format
  std::uint8_t format = 0;           ///< 0 .. 10
  Vec3d scale, offset;               ///< coordinate = stored integer * scale + offset; finite, scale not zero
  std::vector<Dimension> dimensions; ///< those of the format, then those of extra bytes, with unique names
  std::string wkt;                   ///< the reference system, where the file states it as Well Known Text
  std::string crs;                   ///< "EPSG:25832", where it states a code
  bool hasWaveforms = false;

  /// Offset of red, green and blue, 16 bits each, in the record; 0: the format has no colours.
  std::size_t colorOffset() const;
  /// Whether a point is marked as deleted.
  bool isWithheld(const std::uint8_t* record) const;
};

/// Throws Error (truncated, malformed, unsupported, limit) with the place in the file.
Header readHeader(ByteSpan bytes, const std::string& name);

} // namespace imgeo::las
