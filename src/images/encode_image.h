#pragma once
// Pixels -> image files that every browser shows. Deterministic. The raster is not
// empty and its edges are at most `maxRasterEdge`.

#include "images/raster.h"

namespace imgeo {

/// WebP, lossy; `quality` 0 .. 100.
Bytes encodeWebp(const Raster& raster, int quality);

/// WebP that gives every byte back.
Bytes encodeLosslessWebp(const Raster& raster);

/// AVIF with a color sample for every four pixels; `quality` 0 .. 100.
Bytes encodeAvif(const Raster& raster, int quality);

} // namespace imgeo
