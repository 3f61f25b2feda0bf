#include "transcode/verify/check_point_levels.h"

#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "prepare/levels/nearest_point.h"
#include "transcode/verify/points_below.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace imgeo {

namespace {

using compact::CompactPatch;

/// Points with all their attributes, each as a row of numbers, in the order of these.
class PointTable {
public:
  explicit PointTable(std::span<const CompactPatch> segments) {
    std::vector<std::size_t> ends;
    for (const CompactPatch& patch : segments)
      for (std::size_t point = 0; point < patch.wedgeCount(); ++point) {
        const Vec3u& position = patch.positions[patch.wedgePositions[point]];
        values_.insert(values_.end(), {position.x, position.y, position.z});
        for (const compact::Attribute& attribute : patch.attributes)
          values_.insert(values_.end(), attribute.values[point].components.begin(),
                         attribute.values[point].components.end());
        ends.push_back(values_.size());
      }
    std::size_t begin = 0;
    for (const std::size_t end : ends) {
      rows_.push_back(std::span(values_).subspan(begin, end - begin));
      begin = end;
    }
    std::ranges::sort(rows_, precedes);
  }
  PointTable(const PointTable&) = delete;
  PointTable& operator=(const PointTable&) = delete;

  /// Whether all points of another table are here, each as often.
  bool includes(const PointTable& other) const { return std::ranges::includes(rows_, other.rows_, precedes); }

private:
  using Row = std::span<const std::int64_t>;
  static bool precedes(const Row& a, const Row& b) { return std::ranges::lexicographical_compare(a, b); }

  std::vector<std::int64_t> values_;
  std::vector<Row> rows_;
};

/// The largest distance of points from the nearest of others.
double largestDistance(std::span<const Vec3u> points, const NearestPoint& nearest) {
  double largest = 0;
  std::mutex mutex;
  parallelForBlocks(points.size(), [&](std::size_t begin, std::size_t end) {
    double ofBlock = 0;
    for (std::size_t i = begin; i < end; ++i)
      ofBlock = nearest.farther(ofBlock, points[i]);
    const std::lock_guard lock(mutex);
    largest = std::max(largest, ofBlock);
  });
  return largest;
}

class PointLevelCheck {
public:
  PointLevelCheck(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings,
                  const std::filesystem::path& scratch)
      : levels_(levels), fetch_(fetch), findings_(findings), below_(levels, fetch, scratch),
        differs_(levels.index.groups.size()), isTooFar_(levels.index.groups.size()) {}

  void run() {
    const std::vector<LevelGroup>& groups = levels_.index.groups;
    parallelFor(groups.size(), [&](std::size_t number) { check(static_cast<std::uint32_t>(number)); });
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
    if (children.empty())
      return;
    const std::vector<CompactPatch> group = readPointGroup(levels_, number, fetch_);
    for (std::size_t segment = 0; segment < children.size(); ++segment) {
      const std::uint32_t child = children[segment];
      const std::span<const CompactPatch> form(&group[segment], 1);
      differs_[child] = !PointTable(readPointGroup(levels_, child, fetch_)).includes(PointTable(form));
      const double distance = largestDistance(below_.of(child), NearestPoint(wedgePoints(form)));
      constexpr double rounding = 1 + 1e-9;
      isTooFar_[child] = distance > rounding * statedError(levels_.index.groups[child].errorCode);
    }
  }

  const LevelsDescription& levels_;
  const FetchFile& fetch_;
  Findings& findings_;
  PointsBelow below_;
  std::vector<std::uint8_t> differs_;  ///< by group: whether it lacks points of its coarse form
  std::vector<std::uint8_t> isTooFar_; ///< by group: whether points are farther from its coarse form than stated
};

} // namespace

void checkPointLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings,
                      const std::filesystem::path& scratch) {
  std::vector<std::uint32_t> parents(levels.index.groups.size());
  for (const LevelGroup& group : levels.index.groups)
    for (const std::uint32_t child : group.children)
      ++parents[child];
  if (std::ranges::any_of(parents, [](std::uint32_t count) { return count > 1; }))
    return findings.add("Groups of {} have several parents, and those of points have one.", levels.url);
  PointLevelCheck(levels, fetch, findings, scratch).run();
}

} // namespace imgeo
