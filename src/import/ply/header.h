#pragma once
// The header of a PLY file (Turk, "The PLY Polygon File Format", 1994).

#include "base/bytes.h"
#include "imgeo/source_axes.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t byteSizeOf(PlyType type);
inline bool isInteger(PlyType type) {
  return type < PlyType::float32;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> countType; ///< the type of a list's count; absent for a scalar

  bool isList() const { return countType.has_value(); }
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0; ///< as the header states; not yet checked against the bytes
  std::vector<PlyProperty> properties;

  const PlyProperty* find(std::string_view property) const;
};

enum class PlyEncoding : std::uint8_t { ascii, littleEndian, bigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements; ///< in the file's order
  std::size_t bodyOffset = 0;       ///< of the first byte after the header
  /// The direction that points up, where a comment says it as writePly() does: "comment up y".
  std::optional<AxisDirection> up = {};
  std::vector<std::string> textureFiles = {}; ///< of the comments "TextureFile NAME", in their order (textures.h)

  bool hasCarriageReturns = false; ///< lines end with them alone: its own, and those of elements in text

  const PlyElement* find(std::string_view element) const;
};

/// The largest number of elements, of properties of all elements, and of textures that a header may declare.
inline constexpr std::size_t maxPlyElements = 1000, maxPlyProperties = 10000, maxPlyTextures = 10000;

/// Whether the lines of a PLY file end with carriage returns alone, by the beginning of the file.
bool hasPlyCarriageReturns(std::string_view text);

/// Reads the header; skips other comments and obj_info; lines may end with CR LF, or CR alone. Safe for untrusted
/// bytes. Throws Error (truncated, malformed, unsupported, limit) naming `name` and the line.
PlyHeader readPlyHeader(ByteSpan bytes, const std::string& name);

} // namespace imgeo
