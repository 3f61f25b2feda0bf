#pragma once
// The image of new charts, resampled from the source's.

#include "transcode/encode/group_chips.h"
#include "transcode/encode/new_charts.h"

namespace imgeo {

/// New charts of a mesh, and their image.
struct ResampledTexture {
  NewCharts charts;
  ChipSource source;
};

/// The image of new charts, with the colours of the source where the triangles of each chart have them: interpolated in
/// linear light between texels of the triangle's chart in the source alone. A chart covers the texels whose centres are
/// inside of its triangles, and of those around them the ones that a triangle touches.
ChipSource rebakedAtlas(const NewCharts& charts, const TriangleVisits& triangles, const ChipSource& source);

} // namespace imgeo
