#pragma once
// Mesh simplification: vertex clustering followed by edge collapse. Both map vertices to vertices and keep fixed ones
// in position, so a surface with a fixed border still meets its neighbours without cracks.

#include "base/vec.h"
#include "prepare/edge_collapse.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct SimplifiedTriangles {
  static constexpr std::uint32_t none = UINT32_MAX;

  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> corners;       ///< three indices of positions for each triangle
  std::vector<std::uint32_t> triangles;     ///< by triangle: its index in the input
  std::vector<std::uint32_t> vertexOfInput; ///< by position of the input: index in `positions`, or none if no
                                            ///< remaining triangle has it as a corner
  double inputArea = 0;                     ///< of the input, in squared lattice steps
};

/// Simplifies triangles over positions on a lattice to about `triangleCount`, or to the minimum that the topology
/// allows. Positions with `isFixed` keep their position and are not merged with each other. The others move to the
/// positions of minimum quadric error, within the box of all positions. If there are many more positions than
/// requested triangles, vertices are clustered before edges are collapsed, unless collapses are measured.
/// Deterministic.
SimplifiedTriangles simplify(std::span<const Vec3u> positions, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& isFixed, std::size_t triangleCount,
                             CollapseOrder order = CollapseOrder::quadric);

} // namespace imgeo
