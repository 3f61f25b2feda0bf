#pragma once
// Cells and directions of triangles, of which new charts are made.

#include "transcode/encode/chart_triangle.h"

#include <cstdint>
#include <cstdlib>

namespace imgeo {

/// Cells of a triangle have 19 bits along each axis, beside three of the direction and four of the layer.
inline constexpr std::uint32_t cellBits = 19, directionBits = 3, layerBits = 4;

using Normal = Vec3<std::int64_t>;

/// Along the normal, twice the area long.
inline Normal normalOf(const TexturedTriangle& triangle) {
  const auto& [a, b, c] = triangle.points;
  return cross(Normal(b) - Normal(a), Normal(c) - Normal(a));
}

/// Twice the area of a triangle with this normal.
inline double areaOf(const Normal& normal) {
  return length(Vec3d(normal));
}

/// The direction of the axis that is nearest to a normal.
inline Direction dominant(const Normal& normal) {
  int axis = 0;
  for (int other = 1; other < 3; ++other)
    if (std::abs(normal[other]) > std::abs(normal[axis]))
      axis = other;
  return static_cast<Direction>(2 * axis + (normal[axis] < 0 ? 1 : 0));
}

/// The component of a normal along a direction.
inline std::int64_t along(const Normal& normal, Direction direction) {
  return direction % 2 == 0 ? normal[direction / 2] : -normal[direction / 2];
}

/// The cell with edges of 2^shift lattice steps that has the centre of a triangle.
inline std::uint64_t cellOf(const TexturedTriangle& triangle, std::uint32_t shift) {
  const auto& [a, b, c] = triangle.points;
  std::uint64_t cell = 0;
  for (int axis = 0; axis < 3; ++axis)
    cell = cell << cellBits | (a[axis] + b[axis] + c[axis]) / 3 >> shift;
  return cell;
}

} // namespace imgeo
