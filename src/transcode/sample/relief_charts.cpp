#include "transcode/sample/relief_charts.h"

#include "base/parallel.h"
#include "containers/limits.h"

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

/// A colour for a height above the sphere, with a darker line at each hundredth.
std::array<std::uint8_t, 3> colorOf(double height) {
  const double share = std::clamp(5 * (height + 0.1), 0.0, 1.0), hundredths = 100 * height;
  const double light = hundredths - std::floor(hundredths) < 0.1 ? 0.75 : 1;
  const auto channel = [&](double value) { return static_cast<std::uint8_t>(light * value); };
  return {channel(90 + 150 * share), channel(130 + 60 * share), channel(70 + 160 * share * share)};
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

Image ReliefCharts::atlas() const {
  const std::uint64_t cell = std::max<std::uint64_t>(
      1, std::min(std::max<std::uint64_t>(8, 2048 / cellsPerEdge_), maxImageEdge / cellsPerEdge_));
  Image image;
  image.width = image.height = static_cast<std::uint32_t>(cell * cellsPerEdge_);
  image.pixels.resize(std::size_t{3} * image.width * image.height);
  parallelFor(chartCount(), [&](std::size_t chart) { drawChart(image, chart); });
  return image;
}

/// Fills the margin of the cell, too, with the colours of the chart's border.
void ReliefCharts::drawChart(Image& atlas, std::uint64_t chart) const {
  const std::uint64_t pixels = atlas.width / cellsPerEdge_, cell = cells_.of(chart);
  const std::uint64_t side = chart / (perEdge_ * perEdge_), column = chart % perEdge_,
                      row = chart / perEdge_ % perEdge_;
  const auto along = [&](std::uint64_t of, std::uint64_t pixel) {
    const double inCell = (static_cast<double>(pixel) + 0.5) / static_cast<double>(pixels);
    const double share = std::clamp((inCell - margin) / (1 - 2 * margin), 0.0, 1.0);
    const std::uint64_t first = of * surface_.edge() / perEdge_, last = (of + 1) * surface_.edge() / perEdge_;
    return static_cast<double>(first) + share * static_cast<double>(last - first);
  };
  for (std::uint64_t y = 0; y < pixels; ++y)
    for (std::uint64_t x = 0; x < pixels; ++x) {
      const double height = length(Vec3d(surface_.pointOfSide(side, along(column, x), along(row, y)))) - 1;
      const std::uint64_t fromBottom = cell / cellsPerEdge_ * pixels + y, fromLeft = cell % cellsPerEdge_ * pixels + x;
      const std::array<std::uint8_t, 3> color = colorOf(height);
      std::ranges::copy(
          color, atlas.pixels.begin() +
                     static_cast<std::ptrdiff_t>(3 * ((atlas.height - 1 - fromBottom) * atlas.width + fromLeft)));
    }
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
