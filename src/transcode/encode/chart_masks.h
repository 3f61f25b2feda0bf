#pragma once
// The charts of a texture: connected pieces of a mesh in texture coordinates, and the texels of the image that each
// covers, so that images of levels of detail are made without the texels of other charts.

#include "images/raster.h"
#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace imgeo {

using TexelPoint = Vec2<double>;

/// Texels of an image.
struct TexelRect {
  std::uint32_t left = 0, top = 0, width = 0, height = 0;
};

/// The texels that a chart covers, within the smallest rectangle around them.
class ChartMask {
public:
  ChartMask() = default;
  explicit ChartMask(TexelRect rect) : rect_(rect), bits_(std::size_t{rect.width} * rect.height) {}

  ChartMask(TexelRect rect, std::vector<bool> bits) : rect_(rect), bits_(std::move(bits)) {}

  const std::vector<bool>& bits() const { return bits_; } ///< by texel of the rectangle, row by row
  const TexelRect& rect() const { return rect_; }
  /// False outside of the rectangle.
  bool has(std::uint32_t x, std::uint32_t y) const {
    return x - rect_.left < rect_.width && y - rect_.top < rect_.height && bits_[at(x, y)];
  }
  void add(std::uint32_t x, std::uint32_t y) { bits_[at(x, y)] = true; }

private:
  std::size_t at(std::uint32_t x, std::uint32_t y) const {
    return std::size_t{y - rect_.top} * rect_.width + (x - rect_.left);
  }

  TexelRect rect_;
  std::vector<bool> bits_;
};

/// Where texture coordinates are in an image, in texels from its top left corner.
inline Vec2<double> texelOf(Vec2f texCoord, double width, double height) {
  return {double{texCoord.x} * width, (1 - double{texCoord.y}) * height};
}

/// The texture coordinates of the corners of a triangle, within 0 .. 1.
using MappedTriangle = std::array<Vec2f, 3>;

/// Numbers the charts of a mesh in the order of their first wedges, which are welded. Returns how many there are.
std::uint32_t numberCharts(std::vector<std::uint32_t>& ofWedge, const Mesh& mesh);

/// Draws the masks of charts from their triangles, in any order, which are added once by each function.
class ChartPainter {
public:
  /// `count`: of charts.
  ChartPainter(std::uint32_t count, std::uint32_t width, std::uint32_t height);

  void addBounds(std::uint32_t chart, const MappedTriangle& texCoords);
  void begin(); ///< when all bounds are known
  void addInside(std::uint32_t chart, const MappedTriangle& texCoords);
  void addTouched(std::uint32_t chart, const MappedTriangle& texCoords); ///< when all have been added as inside
  std::vector<ChartMask> take() { return std::move(masks_); }

private:
  struct Bounds {
    std::uint32_t left = UINT32_MAX, top = UINT32_MAX, right = 0, bottom = 0;
  };

  std::uint32_t width_, height_;
  std::vector<Bounds> bounds_;
  std::vector<ChartMask> masks_;
  std::vector<bool> isCovered_;
};

struct Charts {
  std::vector<std::uint32_t> ofWedge; ///< the chart of each wedge of the mesh
  std::vector<ChartMask> masks;       ///< by chart
};

/// The charts of a mesh of triangles by its first set of texture coordinates, all within 0 .. 1. Two triangles are of
/// one chart where they share a corner with equal texture coordinates. A chart covers the texels whose centres are
/// inside of its triangles, and of the texels that these touch those whose centres are in no triangle.
Charts chartsOf(const Mesh& mesh, std::uint32_t width, std::uint32_t height);

} // namespace imgeo
