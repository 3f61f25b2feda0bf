#pragma once
// Rasters made smaller, so that what they say stays what it was.

#include "images/raster.h"

namespace imgeo {

/// What the bytes of a raster say.
enum class PixelContent : std::uint8_t {
  color,      ///< sRGB, weighted by alpha, averaged as light
  numbers,    ///< averaged one by one
  directions, ///< red, green, blue are a unit vector, as in normal maps: averaged and of length 1 again
};

/// The size of an image whose longest edge is `longest`, in the same proportions; its own
/// where that is no longer.
struct RasterSize {
  std::uint32_t width = 0, height = 0;
};
RasterSize fittedSize(RasterSize size, std::uint32_t longest);

/// Every pixel is the mean of what it covers. `size` is no larger than the raster along
/// either edge, and not empty.
Raster shrunk(const Raster& raster, RasterSize size, PixelContent content);

} // namespace imgeo
