#pragma once
// A relief with texture coordinates in many charts, as atlases of photogrammetry are.

#include "containers/png/png.h"
#include "transcode/sample/relief_surface.h"

namespace imgeo {

/// The surface of ReliefSurface, cut into rectangles of c x c on each side of the cube: every rectangle is a chart with
/// vertices of its own, whose positions along its edges are bit by bit those of its neighbours.
class ReliefCharts {
public:
  /// About `charts` of them, 6 at least and no more than the surface has squares. `triangles` as of ReliefSurface.
  ReliefCharts(std::uint64_t triangles, std::uint64_t charts);

  std::uint64_t chartCount() const { return 6 * perEdge_ * perEdge_; }
  std::uint64_t vertexCount() const { return 6 * verticesPerEdge_ * verticesPerEdge_; }
  std::uint64_t triangleCount() const { return surface_.triangleCount(); }

  Vec3f vertex(std::uint64_t number) const;
  /// Within a cell of the atlas, 0 .. 1, with a margin; charts have their cells in an order without neighbours.
  Vec2f texCoord(std::uint64_t number) const;
  /// The image of the atlas: colours of heights with contour lines, in which neighbouring charts continue each other.
  /// About 2,048 pixels wide, and more where cells would be smaller than 8 pixels; at most 4,096.
  Image atlas() const;
  /// The vertices of a triangle, counterclockwise seen from outside.
  std::array<std::uint64_t, 3> triangle(std::uint64_t number) const;

private:
  /// Where a vertex is along one direction of a side.
  struct Along {
    std::uint64_t chart = 0, square = 0; ///< of the charts, of the squares
    double share = 0;                    ///< 0 .. 1, of its chart
  };
  Along along(std::uint64_t vertex) const;
  void drawChart(Image& atlas, std::uint64_t chart) const;

  ReliefSurface surface_;
  std::uint64_t perEdge_;         ///< charts
  std::uint64_t verticesPerEdge_; ///< one more than squares for each chart
  Scattering cells_;
  std::uint64_t cellsPerEdge_ = 1;
};

} // namespace imgeo
