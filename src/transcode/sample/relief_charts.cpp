#include "transcode/sample/relief_charts.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// The share of an atlas cell on each side of its chart.
constexpr double margin = 1.0 / 16;

/// Which of `parts` parts of about equal length of 0 .. count - 1 contains the number; part n begins at
/// ⌊n count / parts⌋.
std::uint64_t partOf(std::uint64_t number, std::uint64_t count, std::uint64_t parts) {
  return ((number + 1) * parts - 1) / count;
}

} // namespace

ReliefCharts::ReliefCharts(std::uint64_t triangles, std::uint64_t charts)
    : surface_(triangles),
      perEdge_(std::clamp<std::uint64_t>(
          static_cast<std::uint64_t>(std::llround(std::sqrt(static_cast<double>(charts) / 6))), 1, surface_.edge())),
      verticesPerEdge_(surface_.edge() + perEdge_), cells_(chartCount(), 3) {
  while (cellsPerEdge_ * cellsPerEdge_ < chartCount())
    ++cellsPerEdge_;
}

ReliefCharts::Along ReliefCharts::along(std::uint64_t vertex) const {
  const std::uint64_t n = surface_.edge(), chart = partOf(vertex, verticesPerEdge_, perEdge_);
  const std::uint64_t first = chart * n / perEdge_, last = (chart + 1) * n / perEdge_, square = vertex - chart;
  return {chart, square, static_cast<double>(square - first) / static_cast<double>(last - first)};
}

Vec3f ReliefCharts::vertex(std::uint64_t number) const {
  const std::uint64_t perSide = verticesPerEdge_ * verticesPerEdge_, inSide = number % perSide;
  return surface_.vertexOfSide(number / perSide, along(inSide % verticesPerEdge_).square,
                               along(inSide / verticesPerEdge_).square);
}

Vec2f ReliefCharts::texCoord(std::uint64_t number) const {
  const std::uint64_t perSide = verticesPerEdge_ * verticesPerEdge_, inSide = number % perSide;
  const Along u = along(inSide % verticesPerEdge_), v = along(inSide / verticesPerEdge_);
  const std::uint64_t cell = cells_.of((number / perSide * perEdge_ + v.chart) * perEdge_ + u.chart);
  const auto inAtlas = [&](std::uint64_t of, double share) {
    return static_cast<float>((static_cast<double>(of) + margin + (1 - 2 * margin) * share) /
                              static_cast<double>(cellsPerEdge_));
  };
  return {inAtlas(cell % cellsPerEdge_, u.share), inAtlas(cell / cellsPerEdge_, v.share)};
}

std::array<std::uint64_t, 3> ReliefCharts::triangle(std::uint64_t number) const {
  const std::uint64_t n = surface_.edge(), square = number / 2, side = square / (n * n);
  const std::uint64_t u = square % n, v = square / n % n;
  const std::uint64_t column = u + partOf(u, n, perEdge_), row = v + partOf(v, n, perEdge_);
  return triangleOfSquare(number, side % 2 == 1, [&](std::uint64_t du, std::uint64_t dv) {
    return (side * verticesPerEdge_ + row + dv) * verticesPerEdge_ + column + du;
  });
}

} // namespace imgeo
