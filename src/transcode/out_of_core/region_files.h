#pragma once
// The work files of regions: triangles or points on their way to the regions, and groups that have been built.

#include "base/file_view.h"
#include "prepare/levels/build_level.h"
#include "transcode/encode/levels.h"
#include "transcode/out_of_core/element_records.h"
#include "transcode/out_of_core/work_folder.h"

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// "scatter-0-17": the file of a task of a pass over a level.
std::string taskFile(const char* pass, std::uint32_t level, std::size_t task);

/// Triangles or points by region, with sums over the level's own triangles.
struct ScatteredElements {
  std::vector<std::vector<float>>
      records; ///< by region, in the order of the source; tags of triangles are tagOfTriangle()
  EdgeLengths lengths;
  std::uint64_t collapsed = 0;         ///< triangles that lost their area on the lattice
  std::vector<std::uint32_t> labels{}; ///< by task, if charts have labels: how many
};

/// Whether the triangle belongs to another region and only touches this one, and its child: the group of the level
/// below that it stands for.
inline std::uint32_t tagOfTriangle(std::uint32_t child, bool isGhost) {
  return child << 1 | (isGhost ? 1u : 0u);
}

inline bool isGhostTag(std::uint32_t tag) {
  return tag & 1;
}

Bytes writeScattered(const ScatteredElements& elements);
/// The floats of the records of each region.
std::vector<std::uint64_t> readScatteredSizes(const std::string& path);
/// Reads the sums alone.
ScatteredElements readScatteredSums(const std::string& path);
/// Appends the records of a region.
void appendScattered(std::vector<float>& records, const std::string& path, std::uint32_t region);

/// Calls visit() with the records of all regions.
void visitScattered(const std::string& path, const std::function<void(std::span<const float>)>& visit);

/// A built group and what its files are like.
struct GroupRow {
  LeveledGroup group;
  GroupFile file;
  ChipRow chip{};
};

/// The groups of a region with their files, and the number of elements of their coarse forms.
struct RegionGroups {
  std::vector<GroupRow> rows;
  std::uint64_t formElements = 0;
  std::uint64_t dataOffset = 0; ///< of the first group's file, behind which the others and then the images follow
};

Bytes writeRegionGroups(const RegionGroups& groups, const std::vector<Bytes>& files,
                        const std::vector<Bytes>& chips = {});
RegionGroups readRegionGroups(ByteSpan bytes, const std::string& path);

/// The floats of a file of records.
std::span<const float> floatsOf(ByteSpan bytes);

} // namespace imgeo
