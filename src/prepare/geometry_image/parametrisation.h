#pragma once
// A parametrisation of a mesh: charts that are disks, each with a map to a rectangle that stretches the surface little
// (Gu, Gortler and Hoppe 2002, "Geometry images"; several charts: Sander et al. 2003, "Multi-chart geometry images").

#include "prepare/geometry_image/disk_embedding.h"

#include <vector>

namespace imgeo {

/// A disk and its map to a rectangle. `boundary`, disk.boundary and `corners` run the same way around the disk: along
/// the rectangle's left side downwards, along its lower, right and upper side.
struct ParametrisedChart {
  Chart chart;
  DiskMesh disk;
  std::vector<std::uint32_t> boundary; ///< half-edges of the chart, from the upper left corner on
  std::vector<std::size_t> corners; ///< indices in `boundary` where sides begin: 4; 3 if there are no more half-edges
  DiskEmbedding embedding;          ///< in the unit square
  bool keepsTexCoords = false;      ///< the embedding is that of the texture coordinates, which fill a rectangle
  double area = 0;                  ///< of the surface
  double aspect = 1;                ///< width of the rectangle divided by its height
};

/// Divides a mesh of triangles into charts along the seams of its texture coordinates and along creases, and these
/// until each is a disk that a rectangle holds with little stretch. A chart whose texture coordinates fill a rectangle
/// keeps them as its parametrisation. Deterministic.
std::vector<ParametrisedChart> parametrise(const Mesh& mesh);

/// The point of a rectangle's border at this distance from its upper left corner, downwards along the left side and on.
Vec2d borderPoint(double distance, Vec2d size);

} // namespace imgeo
