#include "prepare/levels/levels.h"

#include "base/parallel.h"
#include "prepare/levels/coarse_form.h"
#include "prepare/levels/group_triangles.h"
#include "prepare/levels/shared_points.h"
#include "prepare/weld.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

/// New positions are multiples of about this share of a level's mean edge.
constexpr double stepsPerEdge = 16;

/// A level that has more than this share of the triangles of the one below is not worth its bytes.
constexpr double maxLevelShare = 0.9;

constexpr std::uint32_t maxLevels = 32;

/// All triangles of a level.
struct Level {
  Mesh mesh;                             ///< welded; positions are lattice points
  std::vector<std::uint32_t> segments{}; ///< by triangle: the group of the level below that it stands for
};

Level firstLevel(Mesh mesh, std::span<const Vec3u> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.positions[i] = Vec3f(points[i]);
  weld(mesh);
  return {std::move(mesh)};
}

/// By position: whether several groups have it.
std::vector<bool> sharedPositions(const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& groups) {
  SharedPoints shared(mesh.positions.size());
  for (std::uint32_t group = 0; group < groups.size(); ++group)
    for (const std::uint32_t triangle : groups[group])
      for (std::size_t i = 0; i < 3; ++i)
        shared.add(mesh.wedgePositions[mesh.corners[3 * std::size_t{triangle} + i]], group);
  return shared.take();
}

/// Numbers the values of a sorted list from 0.
class SortedNumbers {
public:
  explicit SortedNumbers(std::vector<std::uint32_t> values) : values_(std::move(values)) {
    std::ranges::sort(values_);
    values_.erase(std::unique(values_.begin(), values_.end()), values_.end());
  }
  std::uint32_t of(std::uint32_t value) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(values_, value) - values_.begin());
  }
  const std::vector<std::uint32_t>& values() const { return values_; }

private:
  std::vector<std::uint32_t> values_;
};

/// A group cut out of its level.
struct CutGroup {
  GroupMesh mesh;
  std::vector<std::uint32_t> children; ///< groups of the level below
  std::vector<bool> isFixed;           ///< by position
};

CutGroup cutOut(const Level& level, const std::vector<std::uint32_t>& triangles, const std::vector<bool>& isShared) {
  const Mesh& mesh = level.mesh;
  CutGroup group;
  Patch& patch = group.mesh.patch;
  for (const std::uint32_t triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      patch.corners.push_back(mesh.corners[3 * std::size_t{triangle} + i]);
  const SortedNumbers wedges(patch.corners);
  for (std::uint32_t& corner : patch.corners)
    corner = wedges.of(corner);
  patch.wedgePositions = gather(mesh.wedgePositions, wedges.values());
  static_cast<VertexAttributes&>(patch) = gather(mesh, wedges.values());
  const SortedNumbers positions(patch.wedgePositions);
  for (std::uint32_t& position : patch.wedgePositions)
    position = positions.of(position);
  for (const std::uint32_t position : positions.values()) {
    patch.positions.push_back(Vec3u(mesh.positions[position]));
    group.isFixed.push_back(isShared[position]);
  }
  if (level.segments.empty())
    return group;
  for (const std::uint32_t triangle : triangles)
    group.mesh.segments.push_back(level.segments[triangle]);
  const SortedNumbers children(group.mesh.segments);
  for (std::uint32_t& segment : group.mesh.segments)
    segment = children.of(segment);
  group.children = children.values();
  return group;
}

/// The rounding of a level whose mean edge is twice that of the one below.
std::uint32_t roundingShiftAbove(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    sum += length(Vec3d(mesh.cornerPosition(corner % 3 == 2 ? corner - 2 : corner + 1)) -
                  Vec3d(mesh.cornerPosition(corner)));
  const double steps = 2 * sum / static_cast<double>(mesh.corners.size()) / stepsPerEdge;
  const int width = std::bit_width(static_cast<std::uint32_t>(steps));
  return static_cast<std::uint32_t>(std::max(width - 1, 0));
}

/// The largest coordinate.
std::uint32_t maximumOf(const Mesh& mesh) {
  float largest = 0;
  for (const Vec3f& position : mesh.positions)
    largest = std::max({largest, position.x, position.y, position.z});
  return static_cast<std::uint32_t>(largest);
}

std::vector<Vec3u> pointsOf(const Mesh& mesh) {
  std::vector<Vec3u> points;
  points.reserve(mesh.positions.size());
  for (const Vec3f& position : mesh.positions)
    points.emplace_back(position);
  return points;
}

/// The grid on which positions of a level lie that have been rounded.
std::optional<VertexGrid> gridOf(std::uint32_t roundingShift) {
  if (roundingShift == 0)
    return std::nullopt;
  const std::uint64_t step = std::uint64_t{65536} << roundingShift;
  return VertexGrid{{0, 0, 0}, {step, step, step}};
}

/// The sphere about the centre of the box of a group that contains it and its coarse form.
void setSphere(LeveledGroup& group, const Patch& patch, const std::optional<CoarseForm>& coarse) {
  Box3d box;
  for (const Vec3u& position : patch.positions)
    box.add(Vec3d(position));
  group.center = box.center();
  const auto include = [&](const std::vector<Vec3u>& positions) {
    for (const Vec3u& position : positions)
      group.radius = std::max(group.radius, length(Vec3d(position) - group.center));
  };
  include(patch.positions);
  if (coarse)
    include(coarse->patch.positions);
}

/// Joins the coarse forms of all groups by lattice points.
Level joined(std::vector<std::optional<CoarseForm>>& forms) {
  Level level;
  Mesh& mesh = level.mesh;
  for (std::uint32_t group = 0; group < forms.size(); ++group) {
    const Patch& patch = forms[group]->patch;
    const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
    const std::size_t wedges = mesh.wedgeCount();
    for (const Vec3u& position : patch.positions)
      mesh.positions.push_back(Vec3f(position));
    for (const std::uint32_t position : patch.wedgePositions)
      mesh.wedgePositions.push_back(positions + position);
    if (group == 0)
      static_cast<VertexAttributes&>(mesh) = patch;
    else
      append(mesh, wedges, patch, patch.wedgeCount());
    for (const std::uint32_t corner : patch.corners)
      mesh.corners.push_back(static_cast<std::uint32_t>(wedges) + corner);
    level.segments.insert(level.segments.end(), patch.elementCount(), group);
    forms[group].reset();
  }
  weld(mesh);
  return level;
}

/// Builds one level after the other.
class LevelBuilder {
public:
  LevelBuilder(const LevelOptions& options, const GroupSink& sink) : options_(options), sink_(sink) {}

  Levels run(Level level) {
    maximum_ = maximumOf(level.mesh);
    grid_ = findVertexGrid(pointsOf(level.mesh)); // of an isosurface: a group alone has too few lines to find it by
    for (std::optional<Level> next; (next = buildLevel(level)).has_value();)
      level = *std::move(next);
    return numbered();
  }

private:
  /// Writes the groups of a level. Returns the level above, or nothing if the groups are the roots.
  std::optional<Level> buildLevel(const Level& level) {
    const auto number = static_cast<std::uint32_t>(levels_.size());
    const std::vector<std::vector<std::uint32_t>> groups = groupTriangles(
        level.mesh, options_.groupTriangles, number % 2 == 0 ? GroupFrame::straight : GroupFrame::turned);
    const std::vector<bool> isShared = sharedPositions(level.mesh, groups);
    const std::uint32_t shift = roundingShiftAbove(level.mesh);
    const bool mayBeRoot = groups.size() == 1 || number + 1 == maxLevels;
    std::vector<LeveledGroup>& built = levels_.emplace_back(groups.size());
    std::vector<std::optional<CoarseForm>> forms(groups.size());
    sink_.begin(number, groups.size());
    parallelFor(groups.size(), [&](std::size_t i) {
      CutGroup group = cutOut(level, groups[i], isShared);
      if (!mayBeRoot)
        forms[i] = coarseFormOf(group.mesh.patch, group.isFixed, {options_.ratio, shift, maximum_});
      built[i].level = number;
      built[i].children = std::move(group.children);
      setSphere(built[i], group.mesh.patch, forms[i]);
      built[i].error = forms[i] ? forms[i]->error + largestErrorBelow(built[i]) : 0;
      group.mesh.patch.grid = grid_;
      sink_.take(number, i, std::move(group.mesh));
    });
    if (mayBeRoot)
      return std::nullopt;
    std::size_t count = 0;
    for (const std::optional<CoarseForm>& form : forms)
      count += form->patch.elementCount();
    if (static_cast<double>(count) > maxLevelShare * static_cast<double>(level.mesh.elementCount()))
      return std::nullopt;
    grid_ = gridOf(shift);
    return joined(forms);
  }

  double largestErrorBelow(const LeveledGroup& group) const {
    double largest = 0;
    for (const std::uint32_t child : group.children)
      largest = std::max(largest, levels_[group.level - 1][child].error);
    return largest;
  }

  /// The groups in the order of files, with the numbers of their children in it.
  Levels numbered() {
    Levels levels;
    levels.rootCount = static_cast<std::uint32_t>(levels_.back().size());
    std::uint32_t end = 0;
    for (std::size_t level = levels_.size(); level-- > 0;) {
      end += static_cast<std::uint32_t>(levels_[level].size());
      for (LeveledGroup& group : levels_[level]) {
        for (std::uint32_t& child : group.children)
          child += end;
        if (level + 1 == levels_.size())
          group.error = 0;
        levels.groups.push_back(std::move(group));
      }
    }
    return levels;
  }

  const LevelOptions& options_;
  const GroupSink& sink_;
  std::uint32_t maximum_ = 0;                     ///< of coordinates
  std::vector<std::vector<LeveledGroup>> levels_; ///< children are numbers within the level below
  std::optional<VertexGrid> grid_;                ///< of the positions of the level that is being built
};

} // namespace

Levels buildLevels(Mesh mesh, std::span<const Vec3u> points, const LevelOptions& options, const GroupSink& sink) {
  assert(mesh.topology == Topology::triangles && !mesh.corners.empty() && points.size() == mesh.positions.size());
  return LevelBuilder(options, sink).run(firstLevel(std::move(mesh), points));
}

} // namespace imgeo
