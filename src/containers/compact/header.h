#pragma once
// What stands before the streams of a file: docs/formats/compact.md, "File".

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"

#include <string>

namespace imgeo::compact {

/// What patches of a file may have in common.
struct PatchType {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16;
  bool isBase = false;
  std::vector<std::uint32_t> attributes; ///< places in FileHeader::attributes
  friend bool operator==(const PatchType&, const PatchType&) = default;
};

/// Each stream holds what it is for of one patch after the other. Those of the
/// file's attributes follow, one each.
enum class StreamName : std::uint8_t { sizes, connectivity, parts, positions, wedges, attributes };

struct FileHeader {
  std::vector<AttributeType> attributes;
  std::vector<PatchType> types;
  std::uint32_t patchCount = 0;
  std::vector<std::uint32_t> streamLengths; ///< 0: no patch has any of it

  std::size_t streamCount() const { return static_cast<std::size_t>(StreamName::attributes) + attributes.size(); }
};

/// What a file may have at most: of patches, of their types and of attributes. Its vertices,
/// its wedges and its elements are maxPatchCount each.
inline constexpr std::uint32_t maxFilePatches = 65536, maxFileTypes = 256, maxFileAttributes = 256;

void appendHeader(Bytes& out, const FileHeader& header);

/// Reads the header of a payload, and the place of its first stream. Behind it every
/// stream lies within the payload. Throws Error{truncated, malformed, unsupported, limit}.
struct PlacedHeader {
  FileHeader header;
  std::size_t streams = 0;
};
PlacedHeader readHeader(ByteSpan payload, const std::string& location);

} // namespace imgeo::compact
