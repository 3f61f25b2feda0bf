#pragma once
// Pixels in memory.

#include "base/bytes.h"

#include <cstdint>

namespace imgeo {

/// Rows from the top, pixels from the left, four bytes each: red, green, blue and straight (not premultiplied) alpha.
struct Raster {
  std::uint32_t width = 0, height = 0;
  Bytes pixels; ///< width * height * 4
  friend bool operator==(const Raster&, const Raster&) = default;
};

/// Images with more pixels, or with a longer edge, are not decoded. 2^26 pixels are 8192 x 8192.
inline constexpr std::uint64_t maxRasterPixels = std::uint64_t{1} << 26;
inline constexpr std::uint32_t maxRasterEdge = 16383; ///< the limit of WebP

/// Whether any pixel is not opaque.
bool hasAlpha(const Raster& raster);

} // namespace imgeo
