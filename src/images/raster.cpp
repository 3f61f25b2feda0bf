#include "images/raster.h"

#include "base/error.h"

#include <fmt/format.h>

namespace imgeo {

void requireRasterSize(std::uint64_t width, std::uint64_t height, std::uint64_t maxPixels,
                       const std::string& location) {
  if (width > maxRasterEdge || height > maxRasterEdge || width * height > maxPixels)
    throw Error(ErrorKind::limit, location,
                fmt::format("is an image of {} x {} pixels; more than {} along an edge or {} in all are not decoded",
                            width, height, maxRasterEdge, maxPixels));
}

bool hasAlpha(const Raster& raster) {
  for (std::size_t at = 3; at < raster.pixels.size(); at += 4)
    if (raster.pixels[at] != 255)
      return true;
  return false;
}

} // namespace imgeo
