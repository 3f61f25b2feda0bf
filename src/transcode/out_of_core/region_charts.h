#pragma once
// The charts of the texture of a mesh that memory does not hold. Each piece of the source numbers its own ("labels");
// regions find which of these are one chart, by the vertices that their triangles share.

#include "transcode/encode/chart_masks.h"
#include "transcode/encode/level_images.h"
#include "transcode/out_of_core/level_regions.h"

#include <string>
#include <vector>

namespace imgeo {

/// Adds set `set` of texture coordinates to a piece: the bits of x are the label of the wedge's chart. Returns the
/// number of labels, which are in the order of their first triangles.
std::uint32_t labelCharts(Mesh& piece, std::size_t set);

/// The label in a record of level 0.
std::uint32_t labelOf(const RegionedLevel& level, const float* record);

/// The pairs of labels that a region's vertices join.
Bytes chartPairsOf(const RegionedLevel& level, const WorkFolder& work, std::uint32_t region);

/// The number of each label's chart, in the order of the charts' first triangles, from the files of all pairs.
std::vector<std::uint32_t> joinCharts(std::uint32_t labelCount, const std::vector<std::string>& pairFiles);

/// The masks of all charts of a level that has their numbers, from the scattered triangles.
Bytes drawCharts(const RegionedLevel& level, const WorkFolder& work, RasterSize size);
std::vector<ChartMask> readCharts(const std::string& path);

void addCharts(WorkWriter& out, const std::vector<ChartMask>& masks);
std::vector<ChartMask> takeCharts(WorkReader& in);

} // namespace imgeo
