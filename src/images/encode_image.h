#pragma once
// Encodes pixels into image files that browsers can decode. The same raster gives the same bytes. The raster must not
// be empty, and its edges are at most `maxWebpEdge`.

#include "images/raster.h"

namespace imgeo {

/// WebP, lossy; `quality` 0 .. 100.
Bytes encodeWebp(const Raster& raster, int quality);

/// Lossless WebP; decoding restores every byte, also of pixels whose alpha is 0.
Bytes encodeLosslessWebp(const Raster& raster);

/// AVIF with 4:2:0 chroma subsampling; `quality` 0 .. 100.
Bytes encodeAvif(const Raster& raster, int quality);

} // namespace imgeo
