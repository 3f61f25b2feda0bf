#include "transcode/verify/check_levels.h"

#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "prepare/levels/coarse_form.h"

#include <algorithm>
#include <list>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

using SharedGroup = std::shared_ptr<const GroupTriangles>;

/// Groups that have been read, the last used first. Groups of a level are near their predecessors, so that few have to
/// be read again. Safe to call from any thread.
class GroupCache {
public:
  GroupCache(const LevelsDescription& levels, const FetchFile& fetch) : levels_(levels), fetch_(fetch) {}

  SharedGroup get(std::uint32_t number) {
    if (SharedGroup group = find(number))
      return group;
    auto group = std::make_shared<const GroupTriangles>(readGroup(levels_, number, fetch_));
    const std::lock_guard lock(mutex_);
    groups_.emplace_front(number, group);
    if (groups_.size() > capacity)
      groups_.pop_back();
    return group;
  }

private:
  SharedGroup find(std::uint32_t number) {
    const std::lock_guard lock(mutex_);
    const auto entry = std::ranges::find(groups_, number, [](const auto& candidate) { return candidate.first; });
    if (entry == groups_.end())
      return nullptr;
    groups_.splice(groups_.begin(), groups_, entry);
    return entry->second;
  }

  static constexpr std::size_t capacity = 32;

  const LevelsDescription& levels_;
  const FetchFile& fetch_;
  std::mutex mutex_;
  std::list<std::pair<std::uint32_t, SharedGroup>> groups_;
};

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

/// A segment of a group's coarse form in a parent.
struct ParentSegment {
  std::uint32_t parent, segment;
};

/// By group: its segments in all parents.
std::vector<std::vector<ParentSegment>> parentSegmentsOf(const LevelIndex& index) {
  std::vector<std::vector<ParentSegment>> segments(index.groups.size());
  for (std::uint32_t parent = 0; parent < index.groups.size(); ++parent) {
    const std::vector<std::uint32_t>& children = index.groups[parent].children;
    for (std::uint32_t segment = 0; segment < children.size(); ++segment)
      segments[children[segment]].push_back({parent, segment});
  }
  return segments;
}

/// Checks one level after the other, from 0. Holds the borders of a level and a few groups.
class LevelCheck {
public:
  LevelCheck(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings)
      : levels_(levels), groups_(levels, fetch), findings_(findings), segments_(parentSegmentsOf(levels.index)),
        bounds_(levels.index.groups.size()) {}

  void run() {
    const std::vector<LevelGroup>& groups = levels_.index.groups;
    for (std::size_t end = groups.size(); end > levels_.index.rootCount;) { // levels descend
      std::size_t begin = end;
      while (begin > 0 && groups[begin - 1].level == groups[end - 1].level)
        --begin;
      checkLevel(begin, end);
      end = begin;
    }
  }

private:
  void checkLevel(std::size_t begin, std::size_t end) {
    std::vector<std::vector<Vec3u>> borders(end - begin);
    parallelFor(borders.size(), [&](std::size_t i) {
      borders[i] = borderPointsOf(*groups_.get(static_cast<std::uint32_t>(begin + i)));
    });
    const SharedBorderPoints shared(std::exchange(borders, {}));
    std::vector<std::uint8_t> differs(end - begin), isTooFar(end - begin);
    parallelFor(differs.size(), [&](std::size_t i) {
      const auto number = static_cast<std::uint32_t>(begin + i);
      const SharedGroup group = groups_.get(number);
      GroupTriangles form;
      for (const ParentSegment& at : segments_[number])
        appendSegment(form, *groups_.get(at.parent), at.segment);
      differs[i] = hasOtherBorder(*group, form, shared);
      isTooFar[i] = isFartherThanStated(number, *group, form);
    });
    if (const auto first = std::ranges::find(differs, 1); first != differs.end())
      findings_.add("{} has another border than its coarse form, so that levels do not fit together.",
                    groupUrl(levels_.url,
                             static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(first - differs.begin())));
    if (const auto tooFar = std::ranges::count(isTooFar, 1); tooFar > 0)
      findings_.add("{} of {} groups of level {} are farther from their coarse form than {} states.", tooFar,
                    end - begin, levels_.index.groups[begin].level, levels_.url);
  }

  /// Sets the bound of the distance of level 0 below a group from its coarse form: the group's own largest distance and
  /// the largest bound of a child.
  bool isFartherThanStated(std::uint32_t number, const GroupTriangles& group, const GroupTriangles& form) {
    double below = 0;
    for (const std::uint32_t child : levels_.index.groups[number].children)
      below = std::max(below, bounds_[child]);
    bounds_[number] = below + largestDistance(withoutDegenerate(group), withoutDegenerate(form));
    constexpr double rounding = 1 + 1e-9;
    return bounds_[number] > rounding * statedError(levels_.index.groups[number].errorCode);
  }

  const LevelsDescription& levels_;
  GroupCache groups_;
  Findings& findings_;
  std::vector<std::vector<ParentSegment>> segments_; ///< by group
  std::vector<double> bounds_;                       ///< by group, in lattice steps
};

} // namespace

void checkLevels(const LevelsDescription& levels, const FetchFile& fetch, Findings& findings) {
  LevelCheck(levels, fetch, findings).run();
}

} // namespace imgeo
