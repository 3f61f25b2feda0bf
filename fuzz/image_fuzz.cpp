#include "base/error.h"
#include "images/decode_image.h"
#include "images/encode_image.h"

#include <cstdlib>

/// Requires that a decoded image is the same after encoding and decoding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace imgeo;
  constexpr std::uint64_t maxPixels = 1 << 12;
  try {
    const Raster raster = decodeRaster({data, size}, "fuzz.image", maxPixels);
    if (raster.pixels.size() != std::size_t{4} * raster.width * raster.height || raster.pixels.size() > 4 * maxPixels ||
        decodeRaster(encodeLosslessWebp(raster), "again") != raster)
      std::abort();
  } catch (const Error& error) {
    if (error.message().empty() || error.location() != "fuzz.image")
      std::abort();
  }
  return 0;
}
