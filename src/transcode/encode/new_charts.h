#pragma once
// New charts for a mesh whose texture is cut into charts too small for images of groups: triangles of one region of
// space, projected along one axis of the lattice. A triangle's chart follows from the triangle alone and from sums over
// the mesh, so that the order of triangles does not matter, nor whether memory holds them.

#include "images/resize.h"
#include "transcode/encode/chart_triangle.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace imgeo {

/// The triangles of a chart have their centres in one cell of a grid, are projected along one direction, and cover none
/// of each other's texels: those that others would cover are in further layers, each a chart of its own.
class NewCharts {
public:
  /// A cell of a finer grid, whose triangles have its direction where they do not lie along it.
  struct Cell {
    std::uint64_t cell = 0;
    Direction direction = 0;
  };
  struct Layer {
    std::uint64_t triangle = 0; ///< identityOf()
    std::uint32_t layer = 0;
  };
  struct Chart {
    std::uint64_t key = 0; ///< of its cell, direction and layer
    TexelRect rect;        ///< in the new image
    ChartProjection projection;
  };

  /// Charts that have about as many texels as those of the source, whose image has the size `source`, or fewer where
  /// images of groups would have too many. Nothing where these would be too few, or the surface lies in too many
  /// layers. Throws Error{limit} where finding them, or then resampling, would take more than `maxBytes`.
  static std::optional<NewCharts> of(const TriangleVisits& triangles, RasterSize source, std::uint32_t groupTriangles,
                                     std::uint64_t maxBytes = UINT64_MAX);

  std::uint32_t chartOf(const TexturedTriangle& triangle) const;

  /// Memory of a triangle that others cover, in a deque and with its layer, while layers are found; each texel of a
  /// layer has 8 bytes meanwhile.
  static constexpr std::uint64_t bytesOfCoveredTriangle = sizeof(TexturedTriangle) + 4 + sizeof(Layer);
  /// Memory for a pixel of the new image while it is resampled.
  static constexpr std::uint64_t bytesOfResampledPixel = 13;

  // All of it, for work files.
  RasterSize size;             ///< of the new image
  std::uint32_t cellShift = 0; ///< cells have edges of 2^cellShift lattice steps
  std::vector<Cell> cells;     ///< ascending: those with triangles
  std::vector<Layer> layers;   ///< ascending: the triangles that others of their chart would cover
  std::vector<Chart> charts;   ///< ascending by key

private:
  friend class ChartFinder;
  std::uint64_t keyOf(const TexturedTriangle& triangle, std::uint32_t layer) const;
  Direction directionOf(const TexturedTriangle& triangle) const;
};

} // namespace imgeo
