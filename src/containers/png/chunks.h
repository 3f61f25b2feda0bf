#pragma once
// The chunks of a PNG (ISO/IEC 15948, clause 5), all checked before anything is unpacked.

#include "base/bytes.h"

#include <string>
#include <vector>

namespace imgeo {

struct PngChunks {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 1; ///< stored channels: 1 gray or palette, 3 RGB, 4 RGBA
  bool isPalette = false;
  ByteSpan palette;           ///< RGB of 1 .. 256 entries; empty unless isPalette
  std::vector<ByteSpan> data; ///< contents of the IDAT chunks, together one zlib stream
};

/// Reads the chunks; the result refers to `png`. Each edge is 1 .. maxImageEdge; all checksums are right. Safe for
/// untrusted bytes. Throws Error{truncated, malformed, unsupported, limit} with `location`.
PngChunks readPngChunks(ByteSpan png, const std::string& location);

} // namespace imgeo
