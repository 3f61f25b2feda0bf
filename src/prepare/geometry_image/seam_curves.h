#pragma once
// The curves along which charts meet. Both sides of a curve have the same sequence of points, so that no crack opens
// between geometry images (the zippering of Sander et al. 2003).

#include "prepare/geometry_image/parametrisation.h"

#include <span>
#include <vector>

namespace imgeo {

/// A chain of boundary edges between two junctions, where charts or corners of rectangles meet.
struct SeamCurve {
  std::vector<std::uint32_t> positions; ///< of the mesh; the last may be the first again
  std::vector<double> lengths;          ///< from the first position to each position
};

/// A curve as part of the boundary of a chart.
struct CurveRun {
  std::uint32_t curve = 0;
  bool isReversed = false;
  std::size_t firstEdge = 0; ///< in ParametrisedChart::boundary
};

struct SeamNetwork {
  std::vector<SeamCurve> curves;
  std::vector<std::vector<std::vector<CurveRun>>> runs; ///< by chart and side of its rectangle
};

SeamNetwork seamNetworkOf(const Mesh& mesh, std::span<const ParametrisedChart> charts);

struct GridSize {
  std::uint32_t columns = 2, rows = 2;
};

/// The smallest grid on whose border every curve of the chart has a cell.
GridSize smallestGrid(const std::vector<std::vector<CurveRun>>& sides);

/// A texel on the border of a grid: a point of an edge of the chart's boundary.
struct BorderTexel {
  std::size_t edge = 0; ///< in ParametrisedChart::boundary
  double share = 0;     ///< 0: start of the edge, 1: its end
  Vec3f position;       ///< the same bits on both sides of a curve
};

/// The border of a chart's grid.
struct GridBorder {
  std::vector<BorderTexel> texels;     ///< from the upper left downwards and around
  std::vector<double> vertexDistances; ///< by boundary vertex: its distance along the border, in cells
};

/// The borders of the grids of all charts. `sizes` are at least smallestGrid().
std::vector<GridBorder> gridBorders(const Mesh& mesh, std::span<const ParametrisedChart> charts,
                                    const SeamNetwork& network, std::span<const GridSize> sizes);

} // namespace imgeo
