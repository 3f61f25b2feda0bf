#pragma once
// Few triangles for many. Whatever is done here is a map of vertices to vertices,
// under which some stay where they are: a surface whose border does not move is
// then closed against all that it was closed against before.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

struct SimplifiedTriangles {
  static constexpr std::uint32_t none = UINT32_MAX;

  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> corners;       ///< three positions a triangle
  std::vector<std::uint32_t> triangles;     ///< per triangle: that of the input which it was
  std::vector<std::uint32_t> vertexOfInput; ///< per position of the input: what it has become; none where
                                            ///< no triangle is left
  double areaBefore = 0;                    ///< of the input, in units of the lattice
};

/// Simplifies triangles over positions on a lattice to about `triangleCount`, or as
/// few as there can be. Positions with `isFixed` stay, and each stands for itself;
/// the others move, within the box of all, to where the surface is met best.
/// Many triangles are first gathered in cells, then edges collapse. Deterministic.
SimplifiedTriangles simplify(std::span<const Vec3u> positions, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& isFixed, std::size_t triangleCount);

} // namespace imgeo
