#include "prepare/levels/build_level.h"

#include "base/parallel.h"
#include "prepare/levels/shared_points.h"
#include "prepare/position_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <unordered_map>
#include <utility>

namespace imgeo {

namespace {

/// New positions are multiples of about this share of a level's mean edge.
constexpr double stepsPerEdge = 16;

/// A level that has more than this share of the triangles of the one below is not worth its bytes.
constexpr double maxLevelShare = 0.9;

constexpr double lengthUnits = 16; ///< in a lattice step

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

/// Numbers values in the order of their first use, so that a group does not depend on what else its level has.
class FirstUseNumbers {
public:
  explicit FirstUseNumbers(std::size_t expected) { numbers_.reserve(expected); }
  std::uint32_t of(std::uint32_t value) {
    const auto [entry, isNew] = numbers_.try_emplace(value, static_cast<std::uint32_t>(values_.size()));
    if (isNew)
      values_.push_back(value);
    return entry->second;
  }
  const std::vector<std::uint32_t>& values() const { return values_; }

private:
  std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
  std::vector<std::uint32_t> values_;
};

/// A group cut out of its level.
struct CutGroup {
  GroupMesh mesh;
  std::vector<std::uint32_t> children; ///< groups of the level below
  std::vector<bool> isFixed;           ///< by position
};

CutGroup cutOut(const LevelTriangles& level, const std::vector<std::uint32_t>& triangles,
                const std::vector<bool>& isFixed) {
  const Mesh& mesh = level.mesh;
  CutGroup group;
  Patch& patch = group.mesh.patch;
  for (const std::uint32_t triangle : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      patch.corners.push_back(mesh.corners[3 * std::size_t{triangle} + i]);
  FirstUseNumbers wedges(triangles.size());
  for (std::uint32_t& corner : patch.corners)
    corner = wedges.of(corner);
  patch.wedgePositions = gather(mesh.wedgePositions, wedges.values());
  static_cast<VertexAttributes&>(patch) = gather(mesh, wedges.values());
  FirstUseNumbers positions(patch.wedgePositions.size());
  for (std::uint32_t& position : patch.wedgePositions)
    position = positions.of(position);
  for (const std::uint32_t position : positions.values()) {
    patch.positions.push_back(Vec3u(mesh.positions[position]));
    group.isFixed.push_back(isFixed[position]);
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

} // namespace

void EdgeLengths::add(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const auto units = [](const Vec3f& from, const Vec3f& to) {
    return static_cast<std::uint64_t>(length(Vec3d(to) - Vec3d(from)) * lengthUnits);
  };
  sum_ += units(a, b) + units(b, c) + units(c, a);
  count_ += 3;
}

std::uint32_t EdgeLengths::roundingShiftAbove() const {
  const double mean = static_cast<double>(sum_) / lengthUnits / static_cast<double>(count_);
  const int width = std::bit_width(static_cast<std::uint32_t>(2 * mean / stepsPerEdge));
  return static_cast<std::uint32_t>(std::max(width - 1, 0));
}

bool isWorthwhile(std::uint64_t trianglesAbove, std::uint64_t triangles) {
  return static_cast<double>(trianglesAbove) <= maxLevelShare * static_cast<double>(triangles);
}

std::optional<VertexGrid> gridOfRounding(std::uint32_t roundingShift) {
  if (roundingShift == 0)
    return std::nullopt;
  const std::uint64_t step = std::uint64_t{65536} << roundingShift;
  return VertexGrid{{0, 0, 0}, {step, step, step}};
}

std::optional<VertexGrid> gridOfSample(std::span<const Vec3f> corners) {
  PositionTable table(corners.size());
  for (const Vec3f& corner : corners)
    table.indexOf(Vec3u(corner));
  return findVertexGrid(table.positions);
}

RegionTree regionsOfSample(std::span<const Vec3f> corners, std::uint64_t triangleCount, std::uint32_t regionTriangles,
                           GroupFrame frame) {
  if (triangleCount <= regionTriangles)
    return {};
  const auto axes = axesOf(frame);
  std::vector<FrameKey> keys;
  for (std::size_t corner = 0; corner < corners.size(); corner += 3)
    keys.push_back(keyOfTriangle(axes, corners[corner], corners[corner + 1], corners[corner + 2]));
  return {std::move(keys), triangleCount, regionTriangles};
}

void fixShared(std::vector<bool>& isFixed, const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& groups) {
  SharedPoints shared(mesh.positions.size());
  for (std::uint32_t group = 0; group < groups.size(); ++group)
    for (const std::uint32_t triangle : groups[group])
      for (std::size_t i = 0; i < 3; ++i)
        shared.add(mesh.wedgePositions[mesh.corners[3 * std::size_t{triangle} + i]], group);
  const std::vector<bool> isShared = shared.take();
  for (std::size_t position = 0; position < isShared.size(); ++position)
    if (isShared[position])
      isFixed[position] = true;
}

BuiltGroups buildGroups(const LevelTriangles& level, const std::vector<std::vector<std::uint32_t>>& triangles,
                        const std::vector<bool>& isFixed, const LevelPlan& plan, double ratio,
                        const std::function<void(std::size_t group, GroupMesh mesh)>& take) {
  BuiltGroups built;
  built.groups.resize(triangles.size());
  built.forms.resize(triangles.size());
  parallelFor(triangles.size(), [&](std::size_t i) {
    CutGroup group = cutOut(level, triangles[i], isFixed);
    std::optional<CoarseForm>& form = built.forms[i];
    if (!plan.mayBeRoot)
      form = coarseFormOf(group.mesh.patch, group.isFixed, {ratio, plan.roundingShift, plan.maximum, plan.level == 0});
    built.groups[i].level = plan.level;
    built.groups[i].children = std::move(group.children);
    setSphere(built.groups[i], group.mesh.patch, form);
    built.groups[i].error = form ? form->error : 0;
    group.mesh.patch.grid = plan.grid;
    take(i, std::move(group.mesh));
  });
  return built;
}

void appendForm(LevelTriangles& level, const Patch& patch, std::uint32_t group) {
  Mesh& mesh = level.mesh;
  const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
  const std::size_t wedges = mesh.wedgeCount();
  for (const Vec3u& position : patch.positions)
    mesh.positions.push_back(Vec3f(position));
  if (wedges == 0)
    static_cast<VertexAttributes&>(mesh) = patch;
  else
    append(mesh, wedges, patch, patch.wedgeCount());
  for (const std::uint32_t position : patch.wedgePositions)
    mesh.wedgePositions.push_back(positions + position);
  for (const std::uint32_t corner : patch.corners)
    mesh.corners.push_back(static_cast<std::uint32_t>(wedges) + corner);
  level.segments.insert(level.segments.end(), patch.elementCount(), group);
}

} // namespace imgeo
