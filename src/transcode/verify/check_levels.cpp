#include "transcode/verify/check_levels.h"

#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "prepare/levels/coarse_form.h"

#include <algorithm>
#include <vector>

namespace imgeo {

namespace {

/// The groups of a level, with the number of the first.
struct ReadLevel {
  std::size_t first = 0;
  std::vector<GroupTriangles> groups;
};

/// Groups on the levels above have children with numbers in the level below, which begins at `below`.
ReadLevel readLevel(const LevelsDescription& levels, std::uint32_t level, const FetchFile& fetch) {
  const std::vector<LevelGroup>& all = levels.index.groups;
  const auto isOn = [](std::uint32_t which) {
    return [which](const LevelGroup& group) { return group.level == which; };
  };
  ReadLevel read;
  read.first = static_cast<std::size_t>(std::ranges::find_if(all, isOn(level)) - all.begin());
  read.groups.resize(static_cast<std::size_t>(std::ranges::count_if(all, isOn(level))));
  const auto below = static_cast<std::uint32_t>(read.first + read.groups.size());
  parallelFor(read.groups.size(), [&](std::size_t i) {
    const auto number = static_cast<std::uint32_t>(read.first + i);
    read.groups[i] = readGroup(levels, number, fetch);
    for (const std::uint32_t child : all[number].children)
      read.groups[i].children.push_back(child - below);
  });
  return read;
}

PatchTriangles withoutDegenerate(const GroupTriangles& group) {
  PatchTriangles triangles{group.positions, {}};
  for (std::size_t corner = 0; corner < group.corners.size(); corner += 3) {
    const Vec3u &a = group.positions[group.corners[corner]], &b = group.positions[group.corners[corner + 1]],
                &c = group.positions[group.corners[corner + 2]];
    if (a != b && b != c && c != a)
      triangles.corners.insert(triangles.corners.end(),
                               {group.corners[corner], group.corners[corner + 1], group.corners[corner + 2]});
  }
  return triangles;
}

/// Bounds of the distances of level 0 from the coarse form of each group: its own largest distance and the largest
/// bound of a child.
class ErrorBounds {
public:
  explicit ErrorBounds(const LevelIndex& index) : index_(index), bounds_(index.groups.size()) {}

  /// Adds the groups of a level, of which the coarse forms are in the groups of the level above. Returns the number of
  /// groups that are farther away than the index states.
  std::size_t add(const ReadLevel& level, const ReadLevel& above) {
    const std::vector<GroupTriangles> forms = coarseFormsIn(above.groups, level.groups.size());
    parallelFor(level.groups.size(), [&](std::size_t i) {
      double below = 0;
      for (const std::uint32_t child : index_.groups[level.first + i].children)
        below = std::max(below, bounds_[child]);
      bounds_[level.first + i] =
          below + largestDistance(withoutDegenerate(level.groups[i]), withoutDegenerate(forms[i]));
    });
    constexpr double rounding = 1 + 1e-9;
    std::size_t tooFar = 0;
    for (std::size_t i = 0; i < level.groups.size(); ++i)
      tooFar += bounds_[level.first + i] > rounding * statedError(index_.groups[level.first + i].errorCode);
    return tooFar;
  }

private:
  const LevelIndex& index_;
  std::vector<double> bounds_; ///< by group, in lattice steps
};

} // namespace

void checkLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings) {
  ErrorBounds bounds(levels.index);
  ReadLevel level = readLevel(levels, 0, fetch);
  for (std::uint32_t number = 0; number + 1 < levels.index.levelCount(); ++number) {
    ReadLevel above = readLevel(levels, number + 1, fetch);
    if (const auto group = groupWithOtherBorder(level.groups, above.groups))
      findings.add("{} has another border than its coarse form, so that levels do not fit together.",
                   groupUrl(levels.url, static_cast<std::uint32_t>(level.first + *group)));
    if (const std::size_t tooFar = bounds.add(level, above); tooFar > 0)
      findings.add("{} of {} groups of level {} are farther from their coarse form than {} states.", tooFar,
                   level.groups.size(), number, levels.url);
    level = std::move(above);
  }
}

} // namespace imgeo
