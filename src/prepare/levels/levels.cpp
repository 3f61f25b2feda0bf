#include "prepare/levels/levels.h"

#include "prepare/levels/build_level.h"
#include "prepare/levels/group_triangles.h"
#include "prepare/weld.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint32_t maxLevels = 32;
/// The root of a single group is not farther from it than this share of the diagonal of its box. Of unconnected pieces
/// too few would remain for a first image.
constexpr double maxRootError = 1.0 / 32;

LevelTriangles firstLevel(Mesh mesh, std::span<const Vec3u> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    mesh.positions[i] = Vec3f(points[i]);
  weld(mesh);
  return {std::move(mesh)};
}

/// The largest coordinate.
std::uint32_t maximumOf(const Mesh& mesh) {
  float largest = 0;
  for (const Vec3f& position : mesh.positions)
    largest = std::max({largest, position.x, position.y, position.z});
  return static_cast<std::uint32_t>(largest);
}

/// The corners of the sampled triangles of a level.
std::vector<Vec3f> sampleOf(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  const std::uint64_t count = sampledElementCount(mesh.elementCount());
  for (std::uint64_t i = 0; i < count; ++i)
    for (std::uint64_t corner = 0; corner < 3; ++corner)
      corners.push_back(mesh.cornerPosition(3 * sampledElement(i, mesh.elementCount()) + corner));
  return corners;
}

/// A level divided into regions.
struct DividedLevel {
  std::vector<std::vector<std::uint32_t>> regions; ///< the triangles of each
  std::vector<bool> isFixed;                       ///< by position: whether several regions have it
};

DividedLevel divide(const Mesh& mesh, const RegionTree& tree, GroupFrame frame) {
  DividedLevel divided{std::vector<std::vector<std::uint32_t>>(tree.regionCount()),
                       std::vector<bool>(mesh.positions.size())};
  const auto axes = axesOf(frame);
  for (std::uint32_t triangle = 0; triangle < mesh.elementCount(); ++triangle) {
    const std::size_t first = 3 * std::size_t{triangle};
    const TriangleRegions regions(tree, axes, mesh.cornerPosition(first), mesh.cornerPosition(first + 1),
                                  mesh.cornerPosition(first + 2));
    divided.regions[regions.triangle].push_back(triangle);
    for (std::size_t i = 0; i < 3; ++i)
      if (regions.corners[i] != regions.triangle)
        divided.isFixed[mesh.wedgePositions[mesh.corners[first + i]]] = true;
  }
  return divided;
}

/// Joins the coarse forms of all groups by lattice points.
LevelTriangles joined(std::vector<std::optional<CoarseForm>>& forms) {
  LevelTriangles level;
  for (std::uint32_t group = 0; group < forms.size(); ++group) {
    appendForm(level, forms[group]->patch, group);
    forms[group].reset();
  }
  weld(level.mesh);
  return level;
}

/// Builds one level after the other.
class LevelBuilder {
public:
  LevelBuilder(LevelsBelow below, const LevelOptions& options, const GroupSink& sink)
      : options_(options), sink_(sink), levels_(std::move(below)) {}

  Levels run(LevelTriangles level) {
    for (std::optional<LevelTriangles> next; (next = buildLevel(level)).has_value();)
      level = *std::move(next);
    return numberedLevels(std::move(levels_.groups));
  }

private:
  /// Writes the groups of a level. Returns the level above, or nothing if the groups are the roots.
  std::optional<LevelTriangles> buildLevel(const LevelTriangles& level) {
    const Mesh& mesh = level.mesh;
    const auto number = static_cast<std::uint32_t>(levels_.groups.size());
    const GroupFrame frame = frameOfLevel(number);
    const std::vector<Vec3f> sample = sampleOf(mesh);
    if (number == 0) // of an isosurface: a group alone has too few lines to find it by
      levels_.grid = gridOfSample(sample);
    DividedLevel divided =
        divide(mesh, regionsOfSample(sample, mesh.elementCount(), options_.regionTriangles, frame), frame);
    const std::vector<std::vector<std::uint32_t>> groups =
        groupTriangles(mesh, std::move(divided.regions), options_.groupTriangles, frame);
    fixShared(divided.isFixed, mesh, groups);
    EdgeLengths lengths;
    for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3)
      lengths.add(mesh.cornerPosition(corner), mesh.cornerPosition(corner + 1), mesh.cornerPosition(corner + 2));
    const bool mayBeRoot = groups.size() == 1 && mesh.elementCount() <= options_.rootTriangles;
    const LevelPlan plan{number, mayBeRoot || number + 1 == maxLevels, lengths.roundingShiftAbove(), levels_.maximum,
                         levels_.grid};
    sink_.begin(number, groups.size());
    BuiltGroups built = buildGroups(level, groups, divided.isFixed, plan, options_.ratio,
                                    [&](std::size_t i, GroupMesh group) { sink_.take(number, i, std::move(group)); });
    addErrorsBelow(built.groups, levels_.groups);
    levels_.groups.push_back(std::move(built.groups));
    if (plan.mayBeRoot)
      return std::nullopt;
    std::size_t count = 0;
    for (const std::optional<CoarseForm>& form : built.forms)
      count += form->patch.elementCount();
    if (!isWorthwhile(count, mesh.elementCount()))
      return std::nullopt;
    if (groups.size() == 1 && built.forms.front()->error > maxRootError * length(boxOf(mesh).size()))
      return std::nullopt;
    levels_.grid = gridOfRounding(plan.roundingShift);
    return joined(built.forms);
  }

  const LevelOptions& options_;
  const GroupSink& sink_;
  LevelsBelow levels_; ///< the levels that have been built
};

} // namespace

void addErrorsBelow(std::vector<LeveledGroup>& groups, const std::vector<std::vector<LeveledGroup>>& below) {
  for (LeveledGroup& group : groups) {
    double largest = 0;
    for (const std::uint32_t child : group.children)
      largest = std::max(largest, below.back()[child].error);
    group.error += largest;
  }
}

Levels numberedLevels(std::vector<std::vector<LeveledGroup>> byLevel) {
  Levels levels;
  levels.rootCount = static_cast<std::uint32_t>(byLevel.back().size());
  std::uint32_t end = 0;
  for (std::size_t level = byLevel.size(); level-- > 0;) {
    end += static_cast<std::uint32_t>(byLevel[level].size());
    for (LeveledGroup& group : byLevel[level]) {
      for (std::uint32_t& child : group.children)
        child += end;
      if (level + 1 == byLevel.size())
        group.error = 0;
      levels.groups.push_back(std::move(group));
    }
  }
  return levels;
}

Levels buildLevels(Mesh mesh, std::span<const Vec3u> points, const LevelOptions& options, const GroupSink& sink) {
  assert(mesh.topology == Topology::triangles && !mesh.corners.empty() && points.size() == mesh.positions.size());
  LevelTriangles level = firstLevel(std::move(mesh), points);
  LevelsBelow below{{}, maximumOf(level.mesh), {}};
  return LevelBuilder(std::move(below), options, sink).run(std::move(level));
}

Levels buildLevelsAbove(Mesh mesh, std::vector<std::uint32_t> segments, LevelsBelow below, const LevelOptions& options,
                        const GroupSink& sink) {
  assert(!below.groups.empty() && !mesh.corners.empty() && segments.size() == mesh.elementCount());
  weld(mesh);
  return LevelBuilder(std::move(below), options, sink).run({std::move(mesh), std::move(segments)});
}

} // namespace imgeo
