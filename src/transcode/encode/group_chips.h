#pragma once
// The image of a group of a level of detail: the parts of the source's image that its triangles use ("chips"), each
// with a gutter of its own colours, at half the resolution on each further level.

#include "images/resize.h"
#include "prepare/patches.h"
#include "transcode/encode/chip_source.h"

#include <cstdint>
#include <optional>

namespace imgeo {

struct GroupChips {
  Raster image;
  /// The edge of a texel on the surface, in lattice steps: the root of the mean.
  double texelEdge = 0;
};

/// Makes the image of a group. `set` is the number of a set of texture coordinates that states the chart of each wedge
/// (x), and gets the coordinates in the new image. Wedges of several chips are doubled. On level k a texel is the mean
/// of 2^k x 2^k texels of the source, of those that the chart covers; level 0 has the source's own. Nothing, and the
/// patch as it was, where the image would be larger than maxChipEdge. Deterministic.
std::optional<GroupChips> makeChips(Patch& patch, std::uint32_t level, std::size_t set, const ChipSource& source);

/// The size of that image, without making it. Nothing where it would be too large.
std::optional<RasterSize> chipImageSize(const Patch& patch, std::uint32_t level, std::size_t set,
                                        const ChipSource& source);

} // namespace imgeo
