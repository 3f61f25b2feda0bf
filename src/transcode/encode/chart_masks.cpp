#include "transcode/encode/chart_masks.h"

#include "base/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>

namespace imgeo {

namespace {

/// Joins the wedges of a position that differ in other attributes only.
void joinEqual(DisjointSets& sets, const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.wedgeCount());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t wedge) {
    return std::tuple(mesh.wedgePositions[wedge], mesh.texCoords[wedge].x, mesh.texCoords[wedge].y);
  };
  std::ranges::sort(order, {}, key);
  for (std::size_t i = 1; i < order.size(); ++i)
    if (key(order[i]) == key(order[i - 1]))
      sets.merge(order[i], order[i - 1]);
}

/// A triangle in an image.
class TexelTriangle {
public:
  TexelTriangle(const MappedTriangle& texCoords, std::uint32_t width, std::uint32_t height)
      : width_(width), height_(height) {
    for (std::size_t i = 0; i < 3; ++i)
      points_[i] = texelOf(texCoords[i], width, height);
    const TexelPoint &a = points_[0], &b = points_[1], &c = points_[2];
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < 0)
      std::swap(points_[1], points_[2]);
  }

  /// First and last column or row that the triangle touches.
  std::pair<std::uint32_t, std::uint32_t> columns() const { return range(&TexelPoint::x, width_); }
  std::pair<std::uint32_t, std::uint32_t> rows() const { return range(&TexelPoint::y, height_); }

  /// Calls visit(x, y) for the texels whose centres are inside, or with `isTouching` for all that it touches.
  template <typename Visit> void visit(bool isTouching, Visit visit) const {
    const auto [left, right] = columns();
    const auto [top, bottom] = rows();
    for (std::uint32_t y = top; y <= bottom; ++y)
      for (std::uint32_t x = left; x <= right; ++x)
        if (contains({x + 0.5, y + 0.5}, isTouching ? 0.5 : 0))
          visit(x, y);
  }

private:
  std::pair<std::uint32_t, std::uint32_t> range(double TexelPoint::*axis, std::uint32_t count) const {
    const auto [low, high] = std::minmax({points_[0].*axis, points_[1].*axis, points_[2].*axis});
    const double last = count - 1.0;
    return {static_cast<std::uint32_t>(std::clamp(std::floor(low), 0.0, last)),
            static_cast<std::uint32_t>(std::clamp(std::ceil(high) - 1, 0.0, last))};
  }

  /// Whether a square around a point, of half the edge `reach`, meets the triangle, by its edges.
  bool contains(TexelPoint point, double reach) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const TexelPoint &from = points_[i], &to = points_[(i + 1) % 3];
      const double dx = to.x - from.x, dy = to.y - from.y;
      if (dx * (point.y - from.y) - dy * (point.x - from.x) < -reach * (std::abs(dx) + std::abs(dy)))
        return false;
    }
    return true;
  }

  std::array<TexelPoint, 3> points_;
  std::uint32_t width_, height_;
};

} // namespace

std::uint32_t numberCharts(std::vector<std::uint32_t>& ofWedge, const Mesh& mesh) {
  DisjointSets sets(mesh.wedgeCount());
  joinEqual(sets, mesh);
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    sets.merge(mesh.corners[corner], mesh.corners[corner + 1]);
    sets.merge(mesh.corners[corner], mesh.corners[corner + 2]);
  }
  std::uint32_t count = 0;
  ofWedge.resize(mesh.wedgeCount());
  for (std::uint32_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    ofWedge[wedge] = sets.find(wedge) == wedge ? count++ : ofWedge[sets.find(wedge)]; // sets have their first wedge
  return count;
}

ChartPainter::ChartPainter(std::uint32_t count, std::uint32_t width, std::uint32_t height)
    : width_(width), height_(height), bounds_(count) {}

void ChartPainter::addBounds(std::uint32_t chart, const MappedTriangle& texCoords) {
  const TexelTriangle triangle(texCoords, width_, height_);
  Bounds& at = bounds_[chart];
  at.left = std::min(at.left, triangle.columns().first), at.right = std::max(at.right, triangle.columns().second);
  at.top = std::min(at.top, triangle.rows().first), at.bottom = std::max(at.bottom, triangle.rows().second);
}

void ChartPainter::begin() {
  for (const Bounds& at : bounds_)
    masks_.push_back(at.left > at.right ? ChartMask()
                                        : ChartMask({at.left, at.top, at.right - at.left + 1, at.bottom - at.top + 1}));
  isCovered_.resize(std::size_t{width_} * height_);
}

void ChartPainter::addInside(std::uint32_t chart, const MappedTriangle& texCoords) {
  TexelTriangle(texCoords, width_, height_).visit(false, [&](std::uint32_t x, std::uint32_t y) {
    masks_[chart].add(x, y);
    isCovered_[std::size_t{y} * width_ + x] = true;
  });
}

void ChartPainter::addTouched(std::uint32_t chart, const MappedTriangle& texCoords) {
  TexelTriangle(texCoords, width_, height_).visit(true, [&](std::uint32_t x, std::uint32_t y) {
    if (!isCovered_[std::size_t{y} * width_ + x])
      masks_[chart].add(x, y);
  });
}

Charts chartsOf(const Mesh& mesh, std::uint32_t width, std::uint32_t height) {
  Charts charts;
  ChartPainter painter(numberCharts(charts.ofWedge, mesh), width, height);
  const auto forTriangles = [&](void (ChartPainter::*add)(std::uint32_t, const MappedTriangle&)) {
    for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3)
      (painter.*add)(charts.ofWedge[mesh.corners[corner]],
                     {mesh.texCoords[mesh.corners[corner]], mesh.texCoords[mesh.corners[corner + 1]],
                      mesh.texCoords[mesh.corners[corner + 2]]});
  };
  forTriangles(&ChartPainter::addBounds);
  painter.begin();
  forTriangles(&ChartPainter::addInside);
  forTriangles(&ChartPainter::addTouched);
  charts.masks = painter.take();
  return charts;
}

} // namespace imgeo
