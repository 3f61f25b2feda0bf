#include "containers/grid.h"

#include "base/narrow.h"
#include "containers/stored.h"

#include <cassert>

namespace imgeo {

Vec2<std::uint32_t> heightMapSize(const GeometryDescription& geometry) {
  Vec2<std::uint32_t> size;
  for (const PatchDescription& patch : geometry.patches)
    size = {std::max(size.x, patch.gridOrigin.x + patch.implicitMeshSize.x),
            std::max(size.y, patch.gridOrigin.y + patch.implicitMeshSize.y)};
  return size;
}

Lattice heightMapLattice(const DecodeFields& box, Vec2<std::uint32_t> size, std::uint32_t bits) {
  assert(size.x >= 2 && size.y >= 2);
  Lattice lattice{.origin = box.position - box.size * 0.5, .bits = bits};
  const Vec3d unit{box.size.x / (size.x - 1), box.size.y / lattice.maximum(), box.size.z / (size.y - 1)};
  lattice.step = std::max({unit.x, unit.y, unit.z});
  lattice.stretch = unit * (1 / lattice.step);
  return lattice;
}

DecodeFields heightMapBox(const Lattice& lattice, Vec2<std::uint32_t> size) {
  const Vec3d unit = lattice.stretch * lattice.step;
  const Vec3d extent{unit.x * (size.x - 1), unit.y * lattice.maximum(), unit.z * (size.y - 1)};
  return {lattice.origin + extent * 0.5, extent};
}

std::vector<std::uint32_t> gridTriangles(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3u> positions) {
  const std::uint32_t columns = size.x, cells = kind == GridKind::sculpt ? columns : columns - 1;
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * gridTriangleCount(kind, size));
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (positions[a] != positions[b] && positions[b] != positions[c] && positions[c] != positions[a])
      corners.insert(corners.end(), {a, b, c});
  };
  for (std::uint32_t row = 0; row + 1 < size.y; ++row)
    for (std::uint32_t column = 0; column < cells; ++column) {
      const std::uint32_t here = row * columns + column, right = row * columns + (column + 1) % columns;
      add(here, here + columns, right);
      add(here + columns, right + columns, right);
    }
  return corners;
}

std::vector<Vec3f> slopeNormals(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3u> positions,
                                const Lattice& lattice, bool ccw) {
  std::vector<Vec3d> points;
  points.reserve(positions.size());
  for (const Vec3u& position : positions)
    points.push_back(lattice.point(position));
  return slopeNormals(kind, size, points, ccw);
}

std::vector<Vec3f> slopeNormals(GridKind kind, Vec2<std::uint32_t> size, std::span<const Vec3d> points, bool ccw) {
  const bool isClosed = kind == GridKind::sculpt;
  const std::uint32_t columns = size.x, rows = size.y;
  const auto difference = [&](std::uint32_t from, std::uint32_t to) { return points[to] - points[from]; };
  const auto slope = [&](std::uint32_t row, std::uint32_t column) {
    const std::uint32_t first = isClosed ? column + columns - 1 : std::max(column, 1u) - 1,
                        last = isClosed ? column + 1 : std::min(column + 1, columns - 1), above = std::max(row, 1u) - 1,
                        below = std::min(row + 1, rows - 1);
    return cross(difference(above * columns + column, below * columns + column),
                 difference(row * columns + first % columns, row * columns + last % columns));
  };
  std::vector<Vec3f> normals;
  normals.reserve(points.size());
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      Vec3d normal = slope(row, column);
      if (length(normal) == 0)
        normal = slope(row == 0 ? 1 : row - 1, column);
      normals.push_back(unitNormal(normal * (ccw ? 1 : -1)));
    }
  return normals;
}

} // namespace imgeo
