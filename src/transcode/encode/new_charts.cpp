#include "transcode/encode/new_charts.h"

#include "transcode/encode/chart_cells.h"

#include <algorithm>

namespace imgeo {

namespace {

/// The cell of a chart has eight times the edge of a cell whose direction is chosen.
constexpr std::uint32_t chartCellShift = 3;
/// A triangle has the direction of its cell where the cosine of its normal's angle to it is at least this.
constexpr double minCosine = 0.3;

template <typename Row, typename Key> auto rowOf(const std::vector<Row>& rows, std::uint64_t key, Key Row::*of) {
  const auto found = std::ranges::lower_bound(rows, key, {}, of);
  return found != rows.end() && (*found).*of == key ? found : rows.end();
}

} // namespace

Direction NewCharts::directionOf(const TexturedTriangle& triangle) const {
  const Direction ofCell = rowOf(cells, cellOf(triangle, cellShift), &Cell::cell)->direction;
  const Normal normal = normalOf(triangle);
  const double area = areaOf(normal);
  return area == 0 || static_cast<double>(along(normal, ofCell)) >= minCosine * area ? ofCell : dominant(normal);
}

std::uint64_t NewCharts::keyOf(const TexturedTriangle& triangle, std::uint32_t layer) const {
  const std::uint64_t cell = cellOf(triangle, cellShift + chartCellShift);
  return (cell << directionBits | directionOf(triangle)) << layerBits | layer;
}

std::uint32_t NewCharts::chartOf(const TexturedTriangle& triangle) const {
  const auto layer = layers.empty() ? layers.end() : rowOf(layers, identityOf(triangle), &Layer::triangle);
  const std::uint64_t key = keyOf(triangle, layer == layers.end() ? 0 : layer->layer);
  return static_cast<std::uint32_t>(rowOf(charts, key, &Chart::key) - charts.begin());
}

} // namespace imgeo
