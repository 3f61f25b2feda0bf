#pragma once
// Compares the borders of groups with those of their coarse forms, on which it depends that groups of several levels
// fit together. Holds one group and its coarse form at a time, and the borders of the level.

#include "prepare/base_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// The triangles of a group over lattice points.
struct GroupTriangles : PatchTriangles {
  std::vector<std::uint32_t> segments{}; ///< by triangle: index in `children`; empty on level 0
  std::vector<std::uint32_t> children{}; ///< groups of the level below, as indices into its list
};

/// The lattice points at the ends of the edges of a group's border, each once. A border is the sum of the directed
/// edges of triangles, in which opposite edges cancel.
std::vector<Vec3u> borderPointsOf(const GroupTriangles& group);

/// The points that are on the borders of several groups of a level.
class SharedBorderPoints {
public:
  /// `byGroup`: borderPointsOf() of each group of a level.
  explicit SharedBorderPoints(std::span<const std::vector<Vec3u>> byGroup);
  bool contains(const Vec3u& point) const;

private:
  std::vector<Vec3u> points_; ///< ascending by x, y, z
};

/// Whether the coarse form of a group has another border. Edges with an end that is on no other group's border are of
/// the mesh's own open border: they may differ, but the coarse form may have no more of them than the group.
bool hasOtherBorder(const GroupTriangles& group, const GroupTriangles& form, const SharedBorderPoints& shared);

/// Appends the triangles of segment `segment` of a group to the coarse form of that child.
void appendSegment(GroupTriangles& form, const GroupTriangles& parent, std::uint32_t segment);

} // namespace imgeo
