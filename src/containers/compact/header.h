#pragma once
// What stands before the streams of a patch: docs/formats/compact.md, "File".

#include "base/bytes.h"
#include "containers/compact/compact_patch.h"

#include <string>

namespace imgeo::compact {

struct Header {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16, normalShift = 0;
  std::uint32_t vertexCount = 0, wedgeCount = 0, elementCount = 0;
  std::vector<AttributeType> attributes;
  std::optional<Grid> grid;
  std::uint32_t partCount = 0, residualShift = 0; ///< of a base; 0: a patch
  std::vector<std::uint32_t> streamLengths;

  bool hasConnectivity() const { return topology != Topology::points; }
  bool hasSeams() const { return wedgeCount > vertexCount; }
  bool hasParts() const { return partCount > 0; }
  /// Connectivity, parts, positions, wedges and attributes, as far as the above calls for them.
  std::size_t streamCount() const {
    return std::size_t{1} + hasConnectivity() + hasParts() + hasSeams() + attributes.size();
  }
};

void appendHeader(Bytes& out, const Header& header);

/// Reads the header of the patch that begins at byte `first` of a payload, and the
/// place of its first stream. Behind it every count is within its limit and every
/// stream within the payload. Throws Error{truncated, malformed, unsupported, limit}.
struct PlacedHeader {
  Header header;
  std::size_t streams = 0;
};
PlacedHeader readHeader(ByteSpan payload, std::size_t first, const std::string& place);

} // namespace imgeo::compact
