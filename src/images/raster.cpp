#include "images/raster.h"

namespace imgeo {

bool hasAlpha(const Raster& raster) {
  for (std::size_t at = 3; at < raster.pixels.size(); at += 4)
    if (raster.pixels[at] != 255)
      return true;
  return false;
}

} // namespace imgeo
