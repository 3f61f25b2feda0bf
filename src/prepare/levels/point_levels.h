#pragma once
// Levels of detail of point clouds: a tree of groups of points, of which each level has about a quarter of the points
// of the level below, chosen by blue noise (docs/formats/levels.md).

#include "prepare/levels/levels.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace imgeo {

/// Takes the groups of a cloud as they are built, level by level from 0. `begin` is called before the groups of a
/// level; `take` in parallel, with a group's number within its level. `segments`: on level 0 one patch with all points
/// of the group, above the points of the coarse form of each child, in the order of the children. Each has a point.
struct PointGroupSink {
  std::function<void(std::uint32_t level, std::size_t groupCount)> begin;
  std::function<void(std::uint32_t level, std::size_t group, std::vector<Patch> segments)> take;
};

/// Builds the levels of a cloud of at least one point. `points` are its positions on a lattice of at most maxLevelBits.
/// Uses `groupTriangles` of the options as the maximum of points in a group, and `ratio`. Level 0 has every wedge
/// of the mesh once; the points of a group are some of its children's, with their attributes. There is one root, and
/// each other group has one parent. The error of a group is the largest distance of a point of level 0 below it to the
/// nearest point of its coarse form. Deterministic for any number of threads.
Levels buildPointLevels(const Mesh& mesh, std::span<const Vec3u> points, const LevelOptions& options,
                        const PointGroupSink& sink);

} // namespace imgeo
