#include "transcode/verify/points_below.h"

#include "base/error.h"
#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "transcode/verify/verify_work.h"

#include <algorithm>

namespace imgeo {

namespace {

/// So many points, or those of one group, are read at a time.
constexpr std::uint64_t maxRead = std::uint64_t{1} << 19;

} // namespace

std::vector<Vec3u> wedgePoints(std::span<const compact::CompactPatch> patches) {
  std::vector<Vec3u> points;
  for (const compact::CompactPatch& patch : patches)
    for (const std::uint32_t position : patch.wedgePositions)
      points.push_back(patch.positions[position]);
  return points;
}

PointsBelow::PointsBelow(const LevelsDescription& levels, const FetchFile& fetch,
                         const std::filesystem::path& scratch) {
  if (!scratch.empty())
    onDisk_.emplace(scratch);
  orderLeaves(levels.index);
  for (std::size_t begin = 0; begin < leaves_.size();) {
    std::size_t end = begin;
    for (std::uint64_t count = 0; end < leaves_.size() && (end == begin || count < maxRead); ++end)
      count += levels.index.groups[leaves_[end]].vertices;
    std::vector<std::vector<Vec3u>> read(end - begin);
    parallelFor(read.size(),
                [&](std::size_t i) { read[i] = wedgePoints(readPointGroup(levels, leaves_[begin + i], fetch)); });
    for (const std::vector<Vec3u>& points : read) {
      append(points);
      ends_.push_back((ends_.empty() ? 0 : ends_.back()) + points.size());
    }
    begin = end;
  }
}

/// Finds where the leaves below each group are, from the counts of its children, whose numbers are larger than its own.
void PointsBelow::orderLeaves(const LevelIndex& index) {
  const std::vector<LevelGroup>& groups = index.groups;
  leafCount_.resize(groups.size());
  firstLeaf_.resize(groups.size());
  std::vector<bool> isChild(groups.size());
  for (std::size_t group = groups.size(); group-- > 0;) {
    leafCount_[group] = groups[group].children.empty() ? 1 : 0;
    for (const std::uint32_t child : groups[group].children)
      leafCount_[group] += leafCount_[child], isChild[child] = true;
  }
  std::uint32_t count = 0;
  for (std::size_t group = 0; group < groups.size(); ++group) {
    if (!isChild[group])
      firstLeaf_[group] = count, count += leafCount_[group];
    std::uint32_t next = firstLeaf_[group];
    for (const std::uint32_t child : groups[group].children)
      firstLeaf_[child] = next, next += leafCount_[child];
  }
  leaves_.resize(count);
  for (std::uint32_t group = 0; group < groups.size(); ++group)
    if (groups[group].children.empty())
      leaves_[firstLeaf_[group]] = group;
}

void PointsBelow::append(std::span<const Vec3u> points) {
  if (!onDisk_) {
    points_.insert(points_.end(), points.begin(), points.end());
    return;
  }
  try {
    for (const Vec3u& point : points)
      onDisk_->append(point);
  } catch (const Error& error) {
    throw WorkFault{error};
  }
}

std::span<const Vec3u> PointsBelow::of(std::uint32_t group) const {
  const std::uint32_t first = firstLeaf_[group], last = first + leafCount_[group] - 1;
  const std::uint64_t begin = first == 0 ? 0 : ends_[first - 1];
  const std::span<const Vec3u> all = onDisk_ ? onDisk_->values() : std::span<const Vec3u>(points_);
  return all.subspan(begin, ends_[last] - begin);
}

} // namespace imgeo
