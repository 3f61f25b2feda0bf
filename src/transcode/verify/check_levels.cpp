#include "transcode/verify/check_levels.h"

#include "base/parallel.h"
#include "containers/levels/group_file.h"
#include "prepare/levels/coarse_form.h"

#include <algorithm>
#include <cstdint>
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
    corners_ += group->corners.size();
    while (corners_ > maxCorners && groups_.size() > minGroups) {
      corners_ -= groups_.back().second->corners.size();
      groups_.pop_back();
    }
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

  static constexpr std::size_t maxCorners = std::size_t{3} << 20, minGroups = 8;

  const LevelsDescription& levels_;
  const FetchFile& fetch_;
  std::mutex mutex_;
  std::list<std::pair<std::uint32_t, SharedGroup>> groups_;
  std::size_t corners_ = 0; ///< of all of them
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

/// The stated sphere of a group in lattice steps, all of whose numbers are whole.
class StatedSphere {
public:
  StatedSphere(const LevelSphere& sphere, std::uint32_t positionBits)
      : isUnbounded_(sphere.radius == unboundedRadiusCode),
        radius_(std::int64_t{4} * levelUnit(positionBits) * sphere.radius) {
    for (int axis = 0; axis < 3; ++axis)
      center_[axis] = std::int64_t{levelUnit(positionBits)} * sphere.center[axis];
  }

  bool contains(const Vec3u& point) const {
    std::int64_t square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const std::int64_t difference = std::int64_t{point[axis]} - center_[axis];
      square += difference * difference;
    }
    return isUnbounded_ || square <= radius_ * radius_;
  }

  std::int64_t low(int axis) const { return isUnbounded_ ? INT64_MIN : center_[axis] - radius_; }
  std::int64_t high(int axis) const { return isUnbounded_ ? INT64_MAX : center_[axis] + radius_; }

private:
  bool isUnbounded_;
  std::int64_t radius_;
  Vec3<std::int64_t> center_;
};

/// A box around spheres.
class SphereBox {
public:
  void add(const StatedSphere& sphere) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis] = std::min(low_[axis], sphere.low(axis));
      high_[axis] = std::max(high_[axis], sphere.high(axis));
    }
  }
  bool meets(const StatedSphere& sphere) const {
    for (int axis = 0; axis < 3; ++axis)
      if (sphere.high(axis) < low_[axis] || sphere.low(axis) > high_[axis])
        return false;
    return true;
  }

private:
  Vec3<std::int64_t> low_{INT64_MAX, INT64_MAX, INT64_MAX}, high_{INT64_MIN, INT64_MIN, INT64_MIN};
};

/// What is found of the groups of a level.
struct LevelFindings {
  std::vector<std::uint8_t> differs, isTooFar, isOutside;
  explicit LevelFindings(std::size_t count) : differs(count), isTooFar(count), isOutside(count) {}
};

/// Checks one level after the other, from 0. Holds the borders of a run of groups and of those around, and a few
/// groups.
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
  /// So many groups of a level follow one another in space as they do in the index, and are checked at a time.
  static constexpr std::size_t maxRun = 1024;

  void checkLevel(std::size_t begin, std::size_t end) {
    LevelFindings found(end - begin);
    for (std::size_t first = begin; first < end; first += maxRun)
      checkRun(begin, end, first, std::min(first + maxRun, end), found);
    const auto count = [](const std::vector<std::uint8_t>& each) { return std::ranges::count(each, 1); };
    if (const auto first = std::ranges::find(found.differs, 1); first != found.differs.end())
      findings_.add("{} has another border than its coarse form, so that levels do not fit together.",
                    groupUrl(levels_.url, static_cast<std::uint32_t>(begin) +
                                              static_cast<std::uint32_t>(first - found.differs.begin())));
    const std::uint32_t level = levels_.index.groups[begin].level;
    if (const auto tooFar = count(found.isTooFar); tooFar > 0)
      findings_.add("{} of {} groups of level {} are farther from their coarse form than {} states.", tooFar,
                    end - begin, level, levels_.url);
    if (const auto outside = count(found.isOutside); outside > 0)
      findings_.add("{} of {} groups of level {} or their coarse forms reach out of the sphere that {} states.",
                    outside, end - begin, level, levels_.url);
  }

  StatedSphere sphereOf(std::size_t number) const {
    return {levels_.index.groups[number].sphere, levels_.index.positionBits};
  }

  /// The points that a run of groups shares with others of its level: with those whose spheres are near.
  SharedBorderPoints sharedPoints(std::size_t begin, std::size_t end, std::size_t first, std::size_t last) {
    SphereBox box;
    for (std::size_t number = first; number < last; ++number)
      box.add(sphereOf(number));
    std::vector<std::uint32_t> around;
    for (std::size_t number = begin; number < end; ++number)
      if ((number >= first && number < last) || box.meets(sphereOf(number)))
        around.push_back(static_cast<std::uint32_t>(number));
    std::vector<std::vector<Vec3u>> borders(around.size());
    parallelFor(borders.size(), [&](std::size_t i) { borders[i] = borderPointsOf(*groups_.get(around[i])); });
    return SharedBorderPoints(borders);
  }

  void checkRun(std::size_t begin, std::size_t end, std::size_t first, std::size_t last, LevelFindings& found) {
    const SharedBorderPoints shared = sharedPoints(begin, end, first, last);
    parallelFor(last - first, [&](std::size_t i) {
      const auto number = static_cast<std::uint32_t>(first + i);
      const SharedGroup group = groups_.get(number);
      GroupTriangles form;
      for (const ParentSegment& at : segments_[number])
        appendSegment(form, *groups_.get(at.parent), at.segment);
      const auto isInside = [sphere = sphereOf(number)](const Vec3u& point) { return sphere.contains(point); };
      found.differs[number - begin] = hasOtherBorder(*group, form, shared);
      found.isTooFar[number - begin] = isFartherThanStated(number, *group, form);
      found.isOutside[number - begin] =
          !std::ranges::all_of(group->positions, isInside) || !std::ranges::all_of(form.positions, isInside);
    });
  }

  /// Sets the bound of the distance of level 0 below a group from its coarse form: the group's own largest distance and
  /// the largest bound of a child.
  bool isFartherThanStated(std::uint32_t number, const GroupTriangles& group, const GroupTriangles& form) {
    double below = 0;
    for (const std::uint32_t child : levels_.index.groups[number].children)
      below = std::max(below, bounds_[child]);
    const bool isOfSource = levels_.index.groups[number].level == 0;
    bounds_[number] = below + coarseError(withoutDegenerate(group), withoutDegenerate(form), isOfSource);
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
