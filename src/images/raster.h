#pragma once
// Pixels in memory.

#include "base/bytes.h"

#include <cstdint>
#include <string>

namespace imgeo {

/// Rows from the top, pixels from the left, four bytes each: red, green, blue and straight (not premultiplied) alpha.
struct Raster {
  std::uint32_t width = 0, height = 0;
  Bytes pixels; ///< width * height * 4
  friend bool operator==(const Raster&, const Raster&) = default;
};

/// Images with more pixels, or with a longer edge, are not decoded. 2^26 pixels are 8192 x 8192.
inline constexpr std::uint64_t maxRasterPixels = std::uint64_t{1} << 26;
/// The limit where an image has to be changed: 16384 x 16384, the atlases of photogrammetry. Decoding one takes 3.8 GB.
inline constexpr std::uint64_t maxAtlasPixels = std::uint64_t{1} << 28;
inline constexpr std::uint32_t maxRasterEdge = 16384;
inline constexpr std::uint32_t maxWebpEdge = 16383;

/// Throws Error{limit} with `location` for an image of more than `maxPixels` pixels or with a longer edge.
void requireRasterSize(std::uint64_t width, std::uint64_t height, std::uint64_t maxPixels, const std::string& location);

/// Whether any pixel is not opaque.
bool hasAlpha(const Raster& raster);

} // namespace imgeo
