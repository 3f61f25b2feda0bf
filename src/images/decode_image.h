#pragma once
// Image files -> pixels, by GraphicsMagick.

#include "images/raster.h"

#include <string>

namespace imgeo {

/// Reads a file of a kind that `isDecodable`, upright as its EXIF data have it; of 16
/// bits a channel the higher 8. Color profiles are not applied. Of untrusted bytes the
/// header is looked at first: no image of more than `mostPixels` or an edge longer than
/// `maxRasterEdge` is decoded. Throws Error{limit, malformed, unsupported} with `location`.
Raster decodeRaster(ByteSpan bytes, const std::string& location, std::uint64_t mostPixels = maxRasterPixels);

} // namespace imgeo
