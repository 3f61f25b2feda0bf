#pragma once
// Pixels in memory: what images are decoded to, made smaller as, and encoded from.

#include "base/bytes.h"

#include <cstdint>

namespace imgeo {

/// Rows from the top, pixels from the left, four bytes each: red, green, blue, and
/// alpha that they are not multiplied with.
struct Raster {
  std::uint32_t width = 0, height = 0;
  Bytes pixels; ///< width * height * 4
  friend bool operator==(const Raster&, const Raster&) = default;
};

/// More pixels are not decoded: 8192 x 8192.
inline constexpr std::uint64_t maxRasterPixels = std::uint64_t{1} << 26;
inline constexpr std::uint32_t maxRasterEdge = 16383; ///< what WebP holds

/// Whether any pixel lets through what lies behind.
bool hasAlpha(const Raster& raster);

} // namespace imgeo
