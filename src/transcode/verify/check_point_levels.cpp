#include "transcode/verify/check_point_levels.h"

#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "prepare/levels/nearest_point.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace imgeo {

namespace {

using compact::CompactPatch;
using Segments = std::vector<CompactPatch>;

/// A point with all its attributes, as numbers.
using PointValues = std::vector<std::int64_t>;

PointValues pointValues(const CompactPatch& patch, std::size_t point) {
  const Vec3u& position = patch.positions[patch.wedgePositions[point]];
  PointValues values{position.x, position.y, position.z};
  for (const compact::Attribute& attribute : patch.attributes)
    values.insert(values.end(), attribute.values[point].components.begin(), attribute.values[point].components.end());
  return values;
}

std::vector<PointValues> sortedPoints(const Segments& segments) {
  std::vector<PointValues> points;
  for (const CompactPatch& patch : segments)
    for (std::size_t point = 0; point < patch.wedgeCount(); ++point)
      points.push_back(pointValues(patch, point));
  std::ranges::sort(points);
  return points;
}

std::vector<Vec3u> segmentPositions(const Segments& segments) {
  std::vector<Vec3u> positions;
  for (const CompactPatch& patch : segments)
    for (const std::uint32_t position : patch.wedgePositions)
      positions.push_back(patch.positions[position]);
  return positions;
}

/// Whether some points of a child's segment are none of the child's.
bool hasOtherPoints(const Segments& parent, std::size_t segment, const Segments& child) {
  return !std::ranges::includes(sortedPoints(child), sortedPoints({parent[segment]}));
}

class PointLevelCheck {
public:
  PointLevelCheck(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings)
      : levels_(levels), fetch_(fetch), findings_(findings), differs_(levels.index.groups.size()),
        isTooFar_(levels.index.groups.size()), below_(levels.index.groups.size()) {}

  /// From the last level up, which has the points of all groups below.
  void run() {
    const std::vector<LevelGroup>& groups = levels_.index.groups;
    for (std::size_t end = groups.size(); end > 0;) { // levels descend
      std::size_t begin = end;
      while (begin > 0 && groups[begin - 1].level == groups[end - 1].level)
        --begin;
      parallelFor(end - begin, [&](std::size_t i) { check(static_cast<std::uint32_t>(begin + i)); });
      end = begin;
    }
    if (const auto first = std::ranges::find(differs_, 1); first != differs_.end())
      findings_.add("{} lacks points that stand for it on the level above, or has them with other attributes.",
                    groupUrl(levels_.url, static_cast<std::uint32_t>(first - differs_.begin())));
    if (const auto tooFar = std::ranges::count(isTooFar_, 1); tooFar > 0)
      findings_.add("{} of {} groups have points that are farther from their coarse form than {} states.", tooFar,
                    groups.size(), levels_.url);
  }

private:
  /// Compares a group with its children, each of which has one parent.
  void check(std::uint32_t number) {
    const std::vector<std::uint32_t>& children = levels_.index.groups[number].children;
    const Segments group = readPointGroup(levels_, number, fetch_);
    if (children.empty()) {
      below_[number] = segmentPositions(group);
      return;
    }
    for (std::size_t segment = 0; segment < children.size(); ++segment) {
      const std::uint32_t child = children[segment];
      const NearestPoint nearest(segmentPositions({group[segment]}));
      differs_[child] = hasOtherPoints(group, segment, readPointGroup(levels_, child, fetch_));
      double distance = 0;
      for (const Vec3u& position : below_[child])
        distance = nearest.farther(distance, position);
      constexpr double rounding = 1 + 1e-9;
      isTooFar_[child] = distance > rounding * statedError(levels_.index.groups[child].errorCode);
      below_[number].insert(below_[number].end(), below_[child].begin(), below_[child].end());
      below_[child] = {};
    }
  }

  const LevelsDescription& levels_;
  const FetchFile& fetch_;
  Findings& findings_;
  std::vector<std::uint8_t> differs_;     ///< by group: whether it lacks points of its coarse form
  std::vector<std::uint8_t> isTooFar_;    ///< by group: whether points are farther from its coarse form than stated
  std::vector<std::vector<Vec3u>> below_; ///< by group, until its parent has been checked: points of level 0
};

} // namespace

void checkPointLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings) {
  std::vector<std::uint32_t> parents(levels.index.groups.size());
  for (const LevelGroup& group : levels.index.groups)
    for (const std::uint32_t child : group.children)
      ++parents[child];
  if (std::ranges::any_of(parents, [](std::uint32_t count) { return count > 1; }))
    return findings.add("Groups of {} have several parents, and those of points have one.", levels.url);
  PointLevelCheck(levels, fetch, findings).run();
}

} // namespace imgeo
