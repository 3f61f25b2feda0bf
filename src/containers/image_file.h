#pragma once
// Images of vertex data in files, in either format that readers of SIG classic accept.

#include "containers/png/png.h"
#include "imgeo/convert.h"

namespace imgeo {

/// ".png", ".webp".
const char* extensionOf(ImageFormat format);

/// The bytes of an image and the format that they have.
struct EncodedImage {
  ImageFormat format = ImageFormat::png;
  Bytes bytes;
};

/// Writes a PNG, or with ImageFormat::webp the smaller one of WebP and PNG: deflate finds the repeated rows of indices,
/// which WebP does not (docs/decisions/image-format.md). `effort` is that of encodePng and encodeWebp.
EncodedImage encodeImage(const Image& image, ImageFormat format, int effort);

/// Writes a lossless file. `effort` 0 (fastest) .. 9 (smallest). Deterministic.
Bytes encodeImageFile(const Image& image, ImageFormat format, int effort);

/// Reads a PNG or a lossless WebP, by its first bytes. Safe for untrusted bytes. Errors are those of decodePng and
/// decodeWebp. A WebP has four channels; alpha is 255 where the file has none.
Image decodeImageFile(ByteSpan bytes, const std::string& location);

} // namespace imgeo
