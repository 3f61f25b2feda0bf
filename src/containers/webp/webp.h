#pragma once
// Lossless 8-bit images <-> WebP (RFC 9649) of the simple lossless format, by libwebp. The extended format could carry
// a colour profile, with which a browser would alter the pixels.

#include "containers/png/png.h"

namespace imgeo {

/// Writes a lossless WebP that keeps every byte, colours under alpha 0 included. Gray becomes RGB of equal channels,
/// and a palette its colours; both compress to what they need. `effort` 0 (fastest) .. 9 (smallest). Deterministic. The
/// image is not empty and its edges are at most maxImageEdge.
Bytes encodeWebp(const Image& image, int effort);

/// Whether the bytes begin as a WebP file does.
bool isWebp(ByteSpan bytes);

/// Reads a lossless WebP of the simple format as RGBA; alpha is 255 where the file has none. Its edges are at most
/// maxImageEdge, and no bytes follow it. Safe for untrusted bytes. Throws Error{truncated, malformed, unsupported,
/// limit} with `location`.
Image decodeWebp(ByteSpan bytes, const std::string& location);

} // namespace imgeo
