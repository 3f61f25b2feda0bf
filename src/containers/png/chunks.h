#pragma once
// What a PNG (ISO/IEC 15948, clause 5) consists of, checked as a whole before
// anything is unpacked: web/src/decode/png.ts refuses the same with the same kinds.

#include "base/bytes.h"

#include <string>
#include <vector>

namespace imgeo {

struct PngChunks {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 1; ///< that are stored: 1 gray or palette, 3 RGB, 4 RGBA
  bool isPalette = false;
  ByteSpan palette;           ///< RGB of 1 .. 256 entries; empty unless isPalette
  std::vector<ByteSpan> data; ///< the IDATs', which are one zlib stream
};

/// Views of `png`. Each edge is 1 .. maxImageEdge; all check sums hold. Safe for untrusted
/// bytes. Throws Error (truncated, malformed, unsupported, limit) with `location`.
PngChunks readPngChunks(ByteSpan png, const std::string& location);

} // namespace imgeo
