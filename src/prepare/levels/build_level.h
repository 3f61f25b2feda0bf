#pragma once
// Cuts the groups of one level, or of one region of it, and simplifies them.

#include "prepare/levels/coarse_form.h"
#include "prepare/levels/levels.h"
#include "prepare/levels/regions.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

/// The mean length of a level's edges, by which new positions are rounded: to a power of two near 1/16 of it. Sums do
/// not depend on the order in which triangles are added.
class EdgeLengths {
public:
  EdgeLengths() = default;
  EdgeLengths(std::uint64_t sum, std::uint64_t count) : sum_(sum), count_(count) {}

  /// Adds the edges of a triangle of lattice points.
  void add(const Vec3f& a, const Vec3f& b, const Vec3f& c);
  void add(const EdgeLengths& other) { sum_ += other.sum_, count_ += other.count_; }
  /// The rounding of a level whose mean edge is twice that of the edges added.
  std::uint32_t roundingShiftAbove() const;

  std::uint64_t sum() const { return sum_; } ///< in sixteenths of lattice steps
  std::uint64_t count() const { return count_; }

private:
  std::uint64_t sum_ = 0, count_ = 0;
};

/// All triangles of a level, or those of one of its regions.
struct LevelTriangles {
  Mesh mesh;                             ///< welded; positions are lattice points
  std::vector<std::uint32_t> segments{}; ///< by triangle: the group of the level below that it stands for
};

/// What all groups of a level have in common.
struct LevelPlan {
  std::uint32_t level = 0;
  bool mayBeRoot = false;           ///< whether its groups have no coarse form
  std::uint32_t roundingShift = 0;  ///< of coarse forms
  std::uint32_t maximum = 0;        ///< of coordinates
  std::optional<VertexGrid> grid{}; ///< on which positions lie
};

/// Some groups of a level, as they are built.
struct BuiltGroups {
  std::vector<LeveledGroup> groups;             ///< `children` are numbers within the level below; `error` is their own
  std::vector<std::optional<CoarseForm>> forms; ///< nothing where the plan has roots
};

/// A level has no other above it that would have more than nine tenths of its triangles.
bool isWorthwhile(std::uint64_t trianglesAbove, std::uint64_t triangles);

/// The grid of a level's positions after rounding.
std::optional<VertexGrid> gridOfRounding(std::uint32_t roundingShift);

/// The grid of the mesh, by the sampled triangles of level 0 (three lattice points each).
std::optional<VertexGrid> gridOfSample(std::span<const Vec3f> corners);

/// The regions of a level, by its sampled triangles (three lattice points each).
RegionTree regionsOfSample(std::span<const Vec3f> corners, std::uint64_t triangleCount, std::uint32_t regionTriangles,
                           GroupFrame frame);

/// Cuts out and simplifies the groups that `triangles` lists, in parallel. `isFixed`: by position of the mesh, whether
/// several groups or regions have it. `take` gets each group.
BuiltGroups buildGroups(const LevelTriangles& level, const std::vector<std::vector<std::uint32_t>>& triangles,
                        const std::vector<bool>& isFixed, const LevelPlan& plan, double ratio,
                        const std::function<void(std::size_t group, GroupMesh mesh)>& take);

/// Marks the positions that several groups have.
void fixShared(std::vector<bool>& isFixed, const Mesh& mesh, const std::vector<std::vector<std::uint32_t>>& groups);

/// Appends a coarse form of group `group` to a level, without joining positions.
void appendForm(LevelTriangles& level, const Patch& form, std::uint32_t group);

} // namespace imgeo
