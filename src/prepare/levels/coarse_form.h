#pragma once
// The coarse form of a group: what stands in for it on the level above.

#include "prepare/base_mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo {

struct CoarseOptions {
  double ratio = 4; ///< triangles of a group for each of its coarse form
  /// New positions are multiples of 2^roundingShift lattice steps, where that leaves no triangle without area and
  /// pieces are not left out whole.
  std::uint32_t roundingShift = 0;
  std::uint32_t maximum = (1u << 24) - 1; ///< of coordinates
  bool isOfSource = false;                ///< whether the group is of level 0
};

/// Triangles with a border like that of their group, and how far the group is from them.
struct CoarseForm {
  Patch patch;      ///< has at least one triangle
  double error = 0; ///< of coarseError
};

/// Simplifies a group of triangles. Positions with `isFixed` keep their position, so that the sum of the coarse form's
/// directed edges is that of the group's, except for edges of which not both ends are fixed: each becomes an edge or
/// nothing. Vertices have the attributes of the nearest vertex that they stand for; normals of those that are not fixed
/// are the mean of their triangles', weighted by area. Where unconnected pieces have no coarser form, small ones are
/// left out (drop_pieces.h). Deterministic.
CoarseForm coarseFormOf(const Patch& group, const std::vector<bool>& isFixed, const CoarseOptions& options);

/// How far a group is from its coarse form, in lattice steps: the largest distance of a corner from it. On level 0
/// (`isOfSource`) a connected piece counts with the diagonal of its box where that is less, since a piece of that size
/// may vanish. Above, where a piece stands for several, it does not: a surface of many small pieces would vanish, too.
double coarseError(const PatchTriangles& group, const PatchTriangles& form, bool isOfSource);

/// The largest distance of a corner of `from` from the triangles `to`, in lattice steps; infinite without these.
double largestDistance(const PatchTriangles& from, const PatchTriangles& to);

} // namespace imgeo
