#pragma once
// Images for tests.

#include "images/raster.h"

namespace imgeo::testing {

/// Every pixel differs from its neighbours; alpha rises from row to row if `isTransparent`.
inline Raster testRaster(std::uint32_t width, std::uint32_t height, bool isTransparent = false) {
  Raster raster{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (const std::uint32_t value :
           {7 * x + y, 5 * y + 3 * x * x, 255 - 2 * x - y, isTransparent ? 255 * y / height : 255})
        raster.pixels.push_back(static_cast<std::uint8_t>(value));
  return raster;
}

/// Noise, which no format compresses well.
inline Raster noiseRaster(std::uint32_t width, std::uint32_t height) {
  Raster raster{width, height, {}};
  std::uint32_t state = 1; // of a linear congruential generator
  for (std::size_t i = 0; i < std::size_t{4} * width * height; ++i) {
    state = 1664525 * state + 1013904223;
    raster.pixels.push_back(i % 4 == 3 ? 255 : static_cast<std::uint8_t>(state >> 24));
  }
  return raster;
}

/// The raster as an uncompressed TGA of 32 bits a pixel, rows from the bottom.
inline Bytes tgaOf(const Raster& raster) {
  Bytes tga{0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0};
  appendLittle(tga, static_cast<std::uint16_t>(raster.width));
  appendLittle(tga, static_cast<std::uint16_t>(raster.height));
  tga.insert(tga.end(), {32, 8});
  for (std::uint32_t y = raster.height; y-- > 0;)
    for (std::uint32_t x = 0; x < raster.width; ++x) {
      const std::uint8_t* pixel = &raster.pixels[std::size_t{4} * (y * raster.width + x)];
      tga.insert(tga.end(), {pixel[2], pixel[1], pixel[0], pixel[3]});
    }
  return tga;
}

} // namespace imgeo::testing
