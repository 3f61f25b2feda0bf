#pragma once
// A triangle of a mesh in a chart of its texture that is made by projecting it along an axis of the lattice.

#include "transcode/encode/chart_masks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <utility>

namespace imgeo {

/// A triangle of level 0 with its texture.
struct TexturedTriangle {
  std::array<Vec3u, 3> points; ///< on the lattice
  MappedTriangle texCoords;
  std::uint32_t chart = 0; ///< of the source's texture
};

/// Calls a function for each triangle of a mesh, in any order, the same each time.
using TriangleVisits = std::function<void(const std::function<void(const TexturedTriangle&)>& visit)>;

/// One of six directions of a projection: twice the axis, and 1 more against the axis.
using Direction = std::uint8_t;

/// The lattice point as the projection sees it; triangles that face the direction are counterclockwise.
inline Vec2<std::uint32_t> projected(const Vec3u& point, Direction direction) {
  const int axis = direction / 2;
  const Vec2<std::uint32_t> at{point[(axis + 1) % 3], point[(axis + 2) % 3]};
  return direction % 2 == 0 ? at : Vec2<std::uint32_t>{at.y, at.x};
}

/// From lattice points to texels of a new chart.
struct ChartProjection {
  Direction direction = 0;
  double density = 0;  ///< texels of a lattice step
  double x = 0, y = 0; ///< added to the products of the density

  Vec2<double> texelOf(const Vec3u& point) const {
    const Vec2<std::uint32_t> at = projected(point, direction);
    return {at.x * density + x, at.y * density + y};
  }
};

/// The projection of a triangle to its chart, in whole parts of a texel, so that each centre of a texel is in exactly
/// one of the triangles of a surface around it.
class ChartTriangle {
public:
  /// `rect`: the texels of the chart.
  ChartTriangle(const TexturedTriangle& triangle, const ChartProjection& projection, const TexelRect& rect);

  /// The first of the rows around it, and the one behind the last.
  std::pair<std::uint32_t, std::uint32_t> rows() const {
    return {static_cast<std::uint32_t>(rows_.first), static_cast<std::uint32_t>(std::max(rows_.first, rows_.second))};
  }
  /// The shares of the corners at a point; 0 .. 1 within the triangle, which has an area.
  std::array<double, 3> sharesAt(double x, double y) const;
  /// The same for the nearest point of the border; `distance` is how far that is, in texels.
  std::array<double, 3> nearestShares(double x, double y, double& distance) const;

  /// Calls visit(x, y) for the texels whose centres are inside.
  template <typename Visit> void visitInside(Visit visit) const {
    if (area_ > 0)
      visitAround([&](std::uint32_t x, std::uint32_t y) {
        if (contains(x * unit + unit / 2, y * unit + unit / 2))
          visit(x, y);
      });
  }
  /// Calls visit(x, y) for the texels of the rectangle around it.
  template <typename Visit> void visitAround(Visit visit) const {
    for (std::int64_t y = rows_.first; y < rows_.second; ++y)
      for (std::int64_t x = columns_.first; x < columns_.second; ++x)
        visit(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
  }

private:
  using Point = Vec2<std::int64_t>;
  static constexpr std::int64_t unit = 4096; ///< parts of a texel

  bool contains(std::int64_t x, std::int64_t y) const;

  std::array<Point, 3> points_;
  std::int64_t area_ = 0; ///< twice
  std::pair<std::int64_t, std::int64_t> columns_, rows_;
};

/// A number that two triangles with other points or texture coordinates hardly ever share.
std::uint64_t identityOf(const TexturedTriangle& triangle);

} // namespace imgeo
