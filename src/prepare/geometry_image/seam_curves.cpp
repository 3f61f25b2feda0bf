#include "prepare/geometry_image/seam_curves.h"

#include "base/narrow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace imgeo {

namespace {

using EdgeKey = std::uint64_t;

EdgeKey keyOf(std::uint32_t a, std::uint32_t b) {
  return EdgeKey{std::min(a, b)} << 32 | std::max(a, b);
}

/// Divides `total` units among parts in proportion to the differences of `ends`, the cumulative sizes of the parts, at
/// least one to each. Returns the units up to the end of each part.
std::vector<std::uint32_t> divided(std::uint32_t total, std::span<const double> ends) {
  const std::size_t count = ends.size();
  assert(count > 0 && total >= count);
  std::vector<std::uint32_t> result(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double share =
        ends.back() > 0 ? ends[i] / ends.back() : static_cast<double>(i + 1) / static_cast<double>(count);
    const auto min = (i == 0 ? 0 : result[i - 1]) + 1, max = total - narrow<std::uint32_t>(count - 1 - i);
    result[i] = std::clamp(static_cast<std::uint32_t>(share * total + 0.5), min, max);
  }
  result.back() = total;
  return result;
}

/// Builds the network: finds junctions, then walks along every boundary from junction to junction.
class NetworkBuilder {
public:
  NetworkBuilder(const Mesh& mesh, std::span<const ParametrisedChart> charts) : mesh_(mesh), charts_(charts) {}

  SeamNetwork build() && {
    findJunctions();
    for (const ParametrisedChart& chart : charts_)
      network_.runs.push_back(runsOf(chart));
    return std::move(network_);
  }

private:
  std::uint32_t positionAt(const ParametrisedChart& chart, std::size_t edge) const {
    return chart.chart.positions[chart.chart.corners[chart.boundary[edge % chart.boundary.size()]]];
  }
  EdgeKey edgeAt(const ParametrisedChart& chart, std::size_t edge) const {
    return keyOf(positionAt(chart, edge), positionAt(chart, edge + 1));
  }

  void findJunctions() {
    std::vector<std::uint32_t> edgeCounts(mesh_.positions.size());
    isJunction_.resize(mesh_.positions.size());
    for (const ParametrisedChart& chart : charts_) {
      const std::size_t count = chart.boundary.size();
      for (std::size_t i = 0; i < count; ++i) {
        const EdgeKey edge = edgeAt(chart, i);
        if (curveOf_.try_emplace(edge, none).second) {
          ++edgeCounts[positionAt(chart, i)];
          ++edgeCounts[positionAt(chart, i + 1)];
        }
        if (edge == edgeAt(chart, i + 1)) // the end of a slit
          isJunction_[positionAt(chart, i + 1)] = true;
      }
      for (const std::size_t corner : chart.corners)
        isJunction_[positionAt(chart, corner)] = true;
    }
    for (std::size_t position = 0; position < edgeCounts.size(); ++position)
      if (edgeCounts[position] != 2)
        isJunction_[position] = true;
  }

  std::vector<std::vector<CurveRun>> runsOf(const ParametrisedChart& chart) {
    std::vector<std::vector<CurveRun>> sides(chart.corners.size());
    std::size_t side = 0;
    for (std::size_t begin = 0; begin < chart.boundary.size();) {
      if (side + 1 < chart.corners.size() && begin == chart.corners[side + 1])
        ++side;
      std::size_t end = begin + 1;
      while (!isJunction_[positionAt(chart, end)])
        ++end;
      sides[side].push_back(runOf(chart, begin, end));
      begin = end;
    }
    return sides;
  }

  CurveRun runOf(const ParametrisedChart& chart, std::size_t begin, std::size_t end) {
    std::uint32_t& known = curveOf_.at(edgeAt(chart, begin));
    if (known == none) {
      SeamCurve curve;
      double length = 0;
      for (std::size_t i = begin; i <= end; ++i) {
        curve.positions.push_back(positionAt(chart, i));
        curve.lengths.push_back(length);
        length += imgeo::length(Vec3d(mesh_.positions[positionAt(chart, i + 1)]) -
                                Vec3d(mesh_.positions[positionAt(chart, i)]));
      }
      const auto number = narrow<std::uint32_t>(network_.curves.size());
      for (std::size_t i = begin; i < end; ++i)
        curveOf_.at(edgeAt(chart, i)) = number;
      network_.curves.push_back(std::move(curve));
      return {number, false, begin};
    }
    const SeamCurve& curve = network_.curves[known];
    const bool isReversed =
        curve.positions[0] != positionAt(chart, begin) || curve.positions[1] != positionAt(chart, begin + 1);
    return {known, isReversed, begin};
  }

  static constexpr std::uint32_t none = noHalfEdge;

  const Mesh& mesh_;
  std::span<const ParametrisedChart> charts_;
  std::unordered_map<EdgeKey, std::uint32_t> curveOf_; ///< by edge of a boundary
  std::vector<bool> isJunction_;                       ///< by position
  SeamNetwork network_;
};

/// A point of a curve.
struct CurvePoint {
  std::size_t edge = 0;
  double share = 0;
};

/// The points of a curve that both of its sides have.
struct CurveSamples {
  std::vector<CurvePoint> points;   ///< one more than there are intervals
  std::vector<double> vertexShares; ///< by position of the curve: its share of the intervals, 0..1
};

/// With at least as many intervals as edges the points include every vertex; otherwise they are spread by length.
CurveSamples samplesOf(const SeamCurve& curve, std::uint32_t intervals) {
  const std::size_t edgeCount = curve.positions.size() - 1;
  CurveSamples samples;
  if (intervals >= edgeCount) {
    const std::vector<std::uint32_t> ends = divided(intervals, std::span(curve.lengths).subspan(1));
    samples.vertexShares.push_back(0);
    for (std::size_t edge = 0; edge < edgeCount; ++edge) {
      const std::uint32_t begin = edge == 0 ? 0 : ends[edge - 1], count = ends[edge] - begin;
      for (std::uint32_t i = 0; i < count; ++i)
        samples.points.push_back({edge, static_cast<double>(i) / count});
      samples.vertexShares.push_back(static_cast<double>(ends[edge]) / intervals);
    }
    samples.points.push_back({edgeCount - 1, 1});
    return samples;
  }
  const double whole = curve.lengths.back();
  std::size_t edge = 0;
  for (std::uint32_t i = 0; i <= intervals; ++i) {
    const double at = whole * i / intervals;
    while (edge + 1 < edgeCount && curve.lengths[edge + 1] <= at)
      ++edge;
    const double edgeLength = curve.lengths[edge + 1] - curve.lengths[edge];
    samples.points.push_back(
        {edge, edgeLength > 0 ? std::clamp((at - curve.lengths[edge]) / edgeLength, 0.0, 1.0) : 0});
  }
  samples.points.front() = {0, 0};
  samples.points.back() = {edgeCount - 1, 1};
  for (std::size_t i = 0; i <= edgeCount; ++i)
    samples.vertexShares.push_back(whole > 0 ? curve.lengths[i] / whole
                                             : static_cast<double>(i) / static_cast<double>(edgeCount));
  return samples;
}

Vec3f positionOf(const Mesh& mesh, const SeamCurve& curve, const CurvePoint& point) {
  const Vec3d from(mesh.positions[curve.positions[point.edge]]), to(mesh.positions[curve.positions[point.edge + 1]]);
  if (point.share >= 1)
    return mesh.positions[curve.positions[point.edge + 1]];
  return Vec3f(from + (to - from) * point.share);
}

/// Cells of the border between corners: a grid of a chart with three corners has two sides between the last and the
/// first.
std::vector<std::uint32_t> sideCells(GridSize size, std::size_t sideCount) {
  std::vector<std::uint32_t> cells{size.rows - 1, size.columns - 1, size.rows - 1};
  if (sideCount == 4)
    cells.push_back(size.columns - 1);
  else
    cells[2] += size.columns - 1;
  return cells;
}

/// Cells of each run of each side.
std::vector<std::vector<std::uint32_t>> runCells(const SeamNetwork& network,
                                                 const std::vector<std::vector<CurveRun>>& sides, GridSize size) {
  const std::vector<std::uint32_t> cells = sideCells(size, sides.size());
  std::vector<std::vector<std::uint32_t>> result;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    std::vector<double> ends;
    for (const CurveRun& run : sides[side])
      ends.push_back((ends.empty() ? 0 : ends.back()) + network.curves[run.curve].lengths.back());
    std::vector<std::uint32_t> counts = divided(cells[side], ends);
    for (std::size_t i = counts.size(); i-- > 1;)
      counts[i] -= counts[i - 1];
    result.push_back(std::move(counts));
  }
  return result;
}

} // namespace

SeamNetwork seamNetworkOf(const Mesh& mesh, std::span<const ParametrisedChart> charts) {
  return NetworkBuilder(mesh, charts).build();
}

GridSize smallestGrid(const std::vector<std::vector<CurveRun>>& sides) {
  const auto runs = [&](std::size_t side) { return side < sides.size() ? sides[side].size() : 0; };
  return {narrow<std::uint32_t>(std::max({runs(1), runs(3), std::size_t{1}}) + 1),
          narrow<std::uint32_t>(std::max({runs(0), runs(2), std::size_t{1}}) + 1)};
}

std::vector<GridBorder> gridBorders(const Mesh& mesh, std::span<const ParametrisedChart> charts,
                                    const SeamNetwork& network, std::span<const GridSize> sizes) {
  std::vector<std::vector<std::vector<std::uint32_t>>> cells;
  std::vector<std::uint32_t> intervals(network.curves.size(), std::numeric_limits<std::uint32_t>::max());
  for (std::size_t chart = 0; chart < charts.size(); ++chart) {
    cells.push_back(runCells(network, network.runs[chart], sizes[chart]));
    for (std::size_t side = 0; side < cells.back().size(); ++side)
      for (std::size_t i = 0; i < cells.back()[side].size(); ++i) {
        std::uint32_t& fewest = intervals[network.runs[chart][side][i].curve];
        fewest = std::min(fewest, cells.back()[side][i]);
      }
  }
  std::vector<CurveSamples> samples;
  for (std::size_t curve = 0; curve < intervals.size(); ++curve)
    samples.push_back(samplesOf(network.curves[curve], intervals[curve]));

  std::vector<GridBorder> borders;
  for (std::size_t chart = 0; chart < charts.size(); ++chart) {
    GridBorder border;
    std::uint32_t begin = 0;
    for (std::size_t side = 0; side < cells[chart].size(); ++side)
      for (std::size_t i = 0; i < cells[chart][side].size(); ++i) {
        const CurveRun& run = network.runs[chart][side][i];
        const SeamCurve& curve = network.curves[run.curve];
        const std::uint32_t count = cells[chart][side][i], curveIntervals = intervals[run.curve];
        const std::size_t edgeCount = curve.positions.size() - 1;
        for (std::uint32_t texel = 0; texel < count; ++texel) {
          std::uint32_t sample = (2 * texel * curveIntervals + count) / (2 * count);
          if (run.isReversed)
            sample = curveIntervals - sample;
          const CurvePoint& point = samples[run.curve].points[sample];
          const std::size_t edge = run.isReversed ? edgeCount - 1 - point.edge : point.edge;
          border.texels.push_back(
              {run.firstEdge + edge, run.isReversed ? 1 - point.share : point.share, positionOf(mesh, curve, point)});
        }
        for (std::size_t edge = 0; edge < edgeCount; ++edge) {
          const double share = run.isReversed ? 1 - samples[run.curve].vertexShares[edgeCount - edge]
                                              : samples[run.curve].vertexShares[edge];
          border.vertexDistances.push_back(begin + share * count);
        }
        begin += count;
      }
    borders.push_back(std::move(border));
  }
  return borders;
}

} // namespace imgeo
