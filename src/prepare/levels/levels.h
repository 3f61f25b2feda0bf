#pragma once
// Levels of detail: a mesh as a graph of groups of triangles, of which each level has about a quarter of the triangles
// of the level below (docs/formats/levels.md). Borders of groups stay where they are from a level to the next, so that
// groups of several levels fit together without cracks.

#include "prepare/patches.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

inline constexpr std::uint32_t defaultRegionTriangles = 1u << 20;

struct LevelOptions {
  std::uint32_t groupTriangles = 32768; ///< maximum of triangles, or points, in a group
  double ratio = 4;                     ///< triangles of a level for each of the level above
  /// A single group of more triangles has a level above it: the first image of a page is that of the root, which takes
  /// as long to fetch and to decode as it has triangles.
  std::uint32_t rootTriangles = 8192;
  /// About how many triangles, or points of a cloud, a region has: levels of more are cut into regions first
  /// (regions.h).
  std::uint32_t regionTriangles = defaultRegionTriangles;
};

/// Positions for levels have at most so many bits, so that single precision holds every lattice point.
inline constexpr std::uint32_t maxLevelBits = 24;

/// The triangles of a group. Above level 0 each belongs to a segment, the coarse form of a child.
struct GroupMesh {
  Patch patch;
  std::vector<std::uint32_t> segments{}; ///< by triangle: index in the group's children; empty on level 0
};

/// What is known of a group when its level has been built.
struct LeveledGroup {
  std::uint32_t level = 0;
  std::vector<std::uint32_t> children{}; ///< ascending numbers of groups: segment i is the coarse form of child i
  Vec3d center;                          ///< of the box of its vertices, in lattice steps
  double radius = 0;                     ///< of the sphere around it that has its vertices and those of its coarse form
  /// A bound of the distance of level 0 below the group from its coarse form, in lattice steps: the group's own largest
  /// distance and the largest error of a child. 0 for roots.
  double error = 0;
};

/// The groups of all levels, from the highest down, each level region by region and each region in Morton order.
struct Levels {
  std::vector<LeveledGroup> groups;
  std::uint32_t rootCount = 0; ///< groups of the highest level
};

/// Takes the groups of a mesh as they are built, level by level from 0. `begin` is called before the groups of a level;
/// `take` in parallel, with a group's number within its level.
struct GroupSink {
  std::function<void(std::uint32_t level, std::size_t groupCount)> begin;
  std::function<void(std::uint32_t level, std::size_t group, GroupMesh mesh)> take;
};

/// Builds the levels of a mesh of at least one triangle. `points` are its positions on a lattice of at most
/// maxLevelBits. Ends at a level of one group, if that has at most `rootTriangles` or its coarse form would be far from
/// it, or where a level would have more than nine tenths of the triangles of the one below. Level 0 has every triangle
/// of the mesh once. Deterministic for any number of threads.
Levels buildLevels(Mesh mesh, std::span<const Vec3u> points, const LevelOptions& options, const GroupSink& sink);

/// The levels that have been built below another.
struct LevelsBelow {
  std::vector<std::vector<LeveledGroup>> groups; ///< by level; `children` are numbers within the level below
  std::uint32_t maximum = 0;                     ///< of coordinates
  std::optional<VertexGrid> grid{};              ///< of the positions of the next level
};

/// Builds the levels from one above 0 on, whose triangles are corners of lattice points, each with the group of the
/// level below that it stands for, in the order of these. The first call of `begin` is for that level.
Levels buildLevelsAbove(Mesh mesh, std::vector<std::uint32_t> segments, LevelsBelow below, const LevelOptions& options,
                        const GroupSink& sink);

/// Adds to the errors of a level's groups the largest error of a child, which is a group of the last level of `below`.
void addErrorsBelow(std::vector<LeveledGroup>& groups, const std::vector<std::vector<LeveledGroup>>& below);

/// All levels from the highest down, from lists by level whose children are numbers within the level below.
Levels numberedLevels(std::vector<std::vector<LeveledGroup>> byLevel);

} // namespace imgeo
