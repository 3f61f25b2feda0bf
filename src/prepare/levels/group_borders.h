#pragma once
// Compares the borders of groups with those of their coarse forms, on which it depends that groups of several levels
// fit together.

#include "prepare/base_mesh.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

/// The triangles of a group over lattice points.
struct GroupTriangles : PatchTriangles {
  std::vector<std::uint32_t> segments{}; ///< by triangle: index in `children`; empty on level 0
  std::vector<std::uint32_t> children{}; ///< groups of the level below, as indices into its list
};

/// The first group of a level of which the coarse form, in the groups of the level above, has another border, or
/// nothing. A border is the sum of the directed edges of triangles, in which opposite edges cancel. Edges of the mesh's
/// own open border, which no other group has, may differ, but the coarse form may have no more of them than the group.
std::optional<std::size_t> groupWithOtherBorder(std::span<const GroupTriangles> level,
                                                std::span<const GroupTriangles> above);

/// The triangles of the coarse form of each group of a level of `count` groups.
std::vector<GroupTriangles> coarseFormsIn(std::span<const GroupTriangles> above, std::size_t count);

} // namespace imgeo
