#pragma once
// Downscaling of rasters by area averaging, in a way that suits their content.

#include "images/raster.h"

namespace imgeo {

/// The meaning of the channels of a raster.
enum class PixelContent : std::uint8_t {
  color,      ///< sRGB: averaged in linear light, weighted by alpha
  numbers,    ///< each channel averaged on its own
  directions, ///< red, green, blue are a unit vector, as in normal maps: averaged and normalised
};

/// Width and height in pixels.
struct RasterSize {
  std::uint32_t width = 0, height = 0;
};
/// `size` scaled to a longest edge of `maxEdge` in the same proportions; `size` itself if neither edge is longer.
RasterSize sizeWithin(RasterSize size, std::uint32_t maxEdge);

/// Each pixel of the result is the mean of the pixels that it covers. `size` is not empty and no larger than the raster
/// along either edge.
Raster downscaled(const Raster& raster, RasterSize size, PixelContent content);

} // namespace imgeo
