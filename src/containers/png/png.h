#pragma once
// Lossless 8-bit images <-> PNG (ISO/IEC 15948), with only the chunks that carry pixels:
// others could make a browser alter the pixels.

#include "base/bytes.h"

#include <cstdint>
#include <string>

namespace imgeo {

/// Rows from the top, pixels from the left, channels interleaved, no padding.
struct Image {
  std::uint32_t width = 0, height = 0;
  std::uint32_t channels = 3; ///< 1 gray or palette, 3 RGB, 4 RGBA
  Bytes pixels{};             ///< width * height * channels
  Bytes palette{};            ///< empty, or the RGB values of 1 .. 256 entries that the pixels index

  friend bool operator==(const Image&, const Image&) = default;
};

/// Writes IHDR, PLTE if there is a palette, one IDAT and IEND. `effort` 0 (fastest) .. 9 (smallest) bounds the search
/// for filters and matches: docs/decisions/png-effort.md.
/// Deterministic. The image is not empty and its edges are at most maxImageEdge.
Bytes encodePng(const Image& image, int effort);

/// Writes a PNG without filters, for pixels that are compressed data already. Deflates them only if that saves 1/256.
Bytes encodePlainPng(const Image& image);

/// Reads a PNG of 8 bits a channel: gray, RGB, RGBA, or a palette without transparency, which is expanded to RGB. The
/// PNG must not be interlaced, its edges are at most maxImageEdge, all checksums are right, and no bytes follow IEND.
/// Ancillary chunks are skipped; sample values are never altered. Safe for untrusted bytes. Throws Error{truncated,
/// malformed, unsupported, limit} with `location`.
Image decodePng(ByteSpan bytes, const std::string& location);

} // namespace imgeo
