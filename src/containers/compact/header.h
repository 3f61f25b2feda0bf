#pragma once
// The header of a file, before its streams: docs/formats/compact.md, "File".

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"

#include <string>

namespace imgeo::compact {

/// What patches of one type have in common.
struct PatchType {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16;
  bool isBase = false;
  std::vector<std::uint32_t> attributes; ///< indices into FileHeader::attributes
  friend bool operator==(const PatchType&, const PatchType&) = default;
};

/// Every stream holds the data of all patches, one patch after the other. A stream for each attribute follows the
/// named ones.
enum class StreamName : std::uint8_t { sizes, connectivity, segments, positions, wedges, attributes };

/// The version of the format. Readers know both; version 2 is written.
enum class Version : std::uint8_t { one = 1, two = 2 };

struct FileHeader {
  std::vector<AttributeType> attributes;
  std::vector<PatchType> types;
  std::uint32_t patchCount = 0;
  std::vector<std::uint32_t> streamLengths; ///< in bytes; 0: no patch has such data
  Version version = Version::two;

  std::size_t streamCount() const { return static_cast<std::size_t>(StreamName::attributes) + attributes.size(); }
};

/// Limits of a file. All its patches together have at most maxCount vertices, wedges and elements.
inline constexpr std::uint32_t maxFilePatches = 65536, maxFileTypes = 256, maxFileAttributes = 256;

void appendHeader(Bytes& out, const FileHeader& header);

struct ParsedHeader {
  FileHeader header;
  std::size_t streamsByteOffset = 0; ///< of the first stream
};
/// Reads the header of a payload and checks that all streams lie within the payload. Throws Error{truncated, malformed,
/// unsupported, limit} with `location`.
ParsedHeader readHeader(ByteSpan payload, const std::string& location);

} // namespace imgeo::compact
