#pragma once
// The planes on which an isosurface has its vertices: marching cubes puts them on the edges of a grid, so that two of
// three coordinates are multiples of its step.

#include "base/vec.h"

#include <cstdint>
#include <optional>
#include <span>

namespace imgeo {

/// Planes perpendicular to the axes. Most vertices lie on them, as those of isosurfaces do. The coordinate of plane i
/// of an axis is round(origin + i * step), where `origin` and `step` are in 1/65536 lattice steps, below 2^48.
struct VertexGrid {
  Vec3<std::uint64_t> origin, step;
  friend bool operator==(const VertexGrid&, const VertexGrid&) = default;
};

/// Grids are of positions of at most so many bits.
inline constexpr std::uint32_t maxGridBits = 24;

/// Grid line i of an axis.
inline std::int64_t gridLine(const VertexGrid& grid, int axis, std::int64_t i) {
  return (static_cast<std::int64_t>(grid.origin[axis]) + i * static_cast<std::int64_t>(grid.step[axis]) + 32768) >> 16;
}

/// The index of the grid line nearest to a coordinate.
inline std::int64_t nearestGridLine(const VertexGrid& grid, int axis, std::int64_t coordinate) {
  const auto step = static_cast<std::int64_t>(grid.step[axis]);
  const std::int64_t numerator = coordinate * 65536 - static_cast<std::int64_t>(grid.origin[axis]) + step / 2;
  return numerator / step - (numerator % step < 0);
}

/// The first coordinate to which no line before line i is the nearest.
inline std::int64_t firstNearestTo(const VertexGrid& grid, int axis, std::int64_t i) {
  const auto step = static_cast<std::int64_t>(grid.step[axis]);
  return (i * step + static_cast<std::int64_t>(grid.origin[axis]) - step / 2 + 65535) >> 16;
}

/// The axes on which a point lies on the grid, as bits.
inline std::uint32_t gridMask(const VertexGrid& grid, const Vec3u& point) {
  std::uint32_t mask = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (gridLine(grid, axis, nearestGridLine(grid, axis, point[axis])) == point[axis])
      mask |= 1u << axis;
  return mask;
}

/// Whether points have more coordinates on a grid than off it, so that it saves bytes.
bool isWorthwhile(const VertexGrid& grid, std::span<const Vec3u> points);

/// The grid on which most coordinates lie; nothing if there is none. Coordinates have at most
/// `maxGridBits` bits.
std::optional<VertexGrid> findVertexGrid(std::span<const Vec3u> points);

} // namespace imgeo
