#pragma once
// Levels of detail of point clouds: a tree of groups of points, of which each level has about a quarter of the points
// of the level below, chosen by blue noise (docs/formats/levels.md).
//
// A large cloud is divided into regions, each of which is a tree of its own up to one group, its root; further levels
// are built from the roots. So regions can be built one after the other, and those of a cloud in memory are the same.

#include "prepare/levels/levels.h"
#include "prepare/levels/regions.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace imgeo {

/// Takes the groups of a cloud as they are built, level by level. `begin` is called before the groups of a level;
/// `take` in parallel, with a group's number within its level. `segments`: on level 0 one patch with all points of the
/// group, above the points of the coarse form of each child, in the order of the children. Each has a point.
struct PointGroupSink {
  std::function<void(std::uint32_t level, std::size_t groupCount)> begin;
  std::function<void(std::uint32_t level, std::size_t group, std::vector<Patch> segments)> take;
};

/// The groups of some levels, from the lowest up; `children` are numbers within the level below.
using PointLevels = std::vector<std::vector<LeveledGroup>>;

/// Builds the levels of a cloud of at least one point. `points` are its positions on a lattice of at most maxLevelBits.
/// Uses `groupTriangles` of the options as the maximum of points in a group, `ratio`, and `regionTriangles` as about
/// the number of points of a region. Level 0 has every wedge of the mesh once; the points of a group are some of its
/// children's, with their attributes. There is one root, and each other group has one parent. The error of a group is
/// the largest distance of a point of level 0 below it to the nearest point of its coarse form. Deterministic for any
/// number of threads.
Levels buildPointLevels(const Mesh& mesh, std::span<const Vec3u> points, const LevelOptions& options,
                        const PointGroupSink& sink);

/// The positions, by index, of the sampled points of a cloud (sampledElement()).
std::vector<std::uint32_t> sampledPoints(const Mesh& mesh);

/// The regions of a cloud of `pointCount`, by the lattice points of its sampled ones.
RegionTree regionsOfPoints(std::span<const Vec3f> sample, std::uint64_t pointCount, std::uint32_t regionPoints);

/// The level of the root of each region: the lowest on which the largest region is one group. `pointCounts`: by region.
std::uint32_t regionHeight(std::span<const std::uint64_t> pointCounts, std::uint32_t groupPoints);

/// Builds the levels of a region of a cloud, from level 0 up to `height`, which has one group, the region's root.
/// Otherwise as buildPointLevels(); the root has no error yet.
PointLevels buildPointRegion(const Mesh& mesh, std::span<const Vec3u> points, std::uint32_t height,
                             const LevelOptions& options, const PointGroupSink& sink);

/// Builds the levels above the roots of regions, from level `height` + 1 on. `mesh` has the points of all roots, region
/// by region, `ends` says where those of each end. Errors are 0: the points of level 0 are not at hand.
PointLevels buildPointLevelsAbove(const Mesh& mesh, std::span<const Vec3u> points, std::span<const std::uint64_t> ends,
                                  std::uint32_t height, const LevelOptions& options, const PointGroupSink& sink);

} // namespace imgeo
