#pragma once
// Decodes image files into pixels: SGI with a reader of its own, other types with GraphicsMagick.

#include "images/raster.h"

#include <string>

namespace imgeo {

/// Decodes a file of a type that `isDecodable`, oriented as its EXIF data say. Of 16 bits a channel, the higher 8 are
/// kept. Colour profiles are not applied. Safe for untrusted bytes: the header is checked first, and no image of more
/// than `maxPixels` pixels or with an edge longer than `maxRasterEdge` is decoded. Throws Error{limit, malformed,
/// unsupported} with `location`.
Raster decodeRaster(ByteSpan bytes, const std::string& location, std::uint64_t maxPixels = maxRasterPixels);

/// Whether browsers show an image file: one of a type that they know and, as far as imgeo decodes the type, a whole
/// one.
bool isShownInPages(ByteSpan bytes);

} // namespace imgeo
