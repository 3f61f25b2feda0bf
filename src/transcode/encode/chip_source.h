#pragma once
// The image of which those of groups are made.

#include "images/resize.h"
#include "transcode/encode/chart_masks.h"
#include "transcode/encode/chart_triangle.h"

#include <vector>

namespace imgeo {

struct ChipSource {
  Raster image;
  std::vector<ChartMask> charts;
  /// By chart: where positions are in the image. Empty: where the first set of texture coordinates says.
  std::vector<ChartProjection> projections{};
};

} // namespace imgeo
