#pragma once
// The points of level 0 of a cloud, in such an order that those below each group follow one another.

#include "base/scratch_array.h"
#include "base/vec.h"
#include "containers/compact/compact_patch.h"
#include "containers/patch_reader.h"

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

/// The lattice points of patches, one for each wedge.
std::vector<Vec3u> wedgePoints(std::span<const compact::CompactPatch> patches);

class PointsBelow {
public:
  /// Reads all groups without children, each of which has one parent at most. `scratch`: the folder on whose disk the
  /// points are, 12 bytes each; empty: they are in memory. Throws Error for files that cannot be read, WorkFault where
  /// the disk has no room.
  PointsBelow(const LevelsDescription& levels, const FetchFile& fetch, const std::filesystem::path& scratch);

  /// Those below a group, or of a group without children.
  std::span<const Vec3u> of(std::uint32_t group) const;

private:
  void orderLeaves(const LevelIndex& index);
  void append(std::span<const Vec3u> points);

  std::vector<std::uint32_t> leaves_;                ///< groups without children, in the order of their points
  std::vector<std::uint32_t> firstLeaf_, leafCount_; ///< by group: those below, in that order
  std::vector<std::uint64_t> ends_;                  ///< by leaf: the number of points up to its last
  std::vector<Vec3u> points_;
  std::optional<ScratchArray<Vec3u>> onDisk_;
};

} // namespace imgeo
