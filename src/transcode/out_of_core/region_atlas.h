#pragma once
// New charts for the texture of a mesh that memory does not hold, and their image: work files.

#include "transcode/encode/level_images.h"
#include "transcode/out_of_core/level_regions.h"

#include <optional>
#include <string>

namespace imgeo {

/// Makes new charts of the scattered triangles of level 0, which has the numbers of the source's charts. `images` has
/// the source's image and charts. Throws Error{limit} as NewCharts::of() does.
Bytes resampleTexture(const RegionedLevel& level, const WorkFolder& work, const LevelImages& images,
                      std::uint64_t maxBytes);

/// Reads what resampleTexture() wrote. Nothing where there is no way to make new charts.
std::optional<ResampledTexture> readResampled(const std::string& path);

} // namespace imgeo
