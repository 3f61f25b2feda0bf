#include "import/dem/terrain.h"

#include "base/error.h"
#include "import/mesh/metadata_set.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint32_t noVertex = std::numeric_limits<std::uint32_t>::max();

/// Adds the vertices of a mesh when a triangle first uses them.
class TerrainBuilder {
public:
  TerrainBuilder(const HeightGrid& grid, const Ground& ground, bool keepsHeights)
      : grid_(grid), ground_(ground), keepsHeights_(keepsHeights), vertexOf_(grid.heights.size(), noVertex),
        isUpward_(ground.columnStep.x * ground.rowStep.y > ground.columnStep.y * ground.rowStep.x) {}

  /// Adds the triangle of three cells, which are counterclockwise where columns run to the right and rows down; nothing
  /// if one of them has no height.
  void add(std::size_t a, std::size_t b, std::size_t c) {
    if (std::isnan(grid_.heights[a]) || std::isnan(grid_.heights[b]) || std::isnan(grid_.heights[c]))
      return;
    if (!isUpward_)
      std::swap(b, c);
    for (const std::size_t cell : {a, b, c})
      mesh_.corners.push_back(vertexAt(cell));
  }

  bool hasHeight(std::size_t cell) const { return !std::isnan(grid_.heights[cell]); }

  Mesh take() {
    if (keepsHeights_)
      mesh_.namedAttributes.push_back({heightName, 1, std::move(heights_)});
    return std::move(mesh_);
  }

private:
  std::uint32_t vertexAt(std::size_t cell) {
    std::uint32_t& vertex = vertexOf_[cell];
    if (vertex == noVertex) {
      vertex = static_cast<std::uint32_t>(mesh_.positions.size());
      const std::size_t wholeRows = cell / grid_.columns;
      const double column = static_cast<double>(cell % grid_.columns) - (grid_.columns - 1) / 2.0,
                   row = static_cast<double>(wholeRows) - (grid_.rows - 1) / 2.0;
      mesh_.positions.emplace_back(Vec3d{column * ground_.columnStep.x + row * ground_.rowStep.x,
                                         grid_.heights[cell] * ground_.metresPerHeight,
                                         column * ground_.columnStep.y + row * ground_.rowStep.y});
      mesh_.wedgePositions.push_back(vertex);
      if (keepsHeights_)
        heights_.push_back(grid_.heights[cell]);
    }
    return vertex;
  }

  const HeightGrid& grid_;
  const Ground& ground_;
  bool keepsHeights_;
  Mesh mesh_;
  std::vector<float> heights_;          ///< by vertex
  std::vector<std::uint32_t> vertexOf_; ///< by cell
  bool isUpward_; ///< whether columns to the right and rows downwards are seen from above, not mirrored
};

} // namespace

Mesh terrainMesh(const HeightGrid& grid, const Ground& ground, bool keepsHeights, const std::string& name) {
  TerrainBuilder builder(grid, ground, keepsHeights);
  for (std::size_t row = 0; row + 1 < grid.rows; ++row)
    for (std::size_t column = 0; column + 1 < grid.columns; ++column) {
      const std::size_t here = row * grid.columns + column, right = here + 1, below = here + grid.columns,
                        across = below + 1;
      if (builder.hasHeight(below) && builder.hasHeight(right)) {
        builder.add(here, below, right);
        builder.add(below, across, right);
      } else { // the other diagonal
        builder.add(here, below, across);
        builder.add(here, across, right);
      }
    }
  Mesh mesh = builder.take();
  if (mesh.corners.empty())
    throw Error(ErrorKind::malformed, name, "has no three neighbouring cells with heights");
  return mesh;
}

void addGeoreference(SceneGraph& graph, std::size_t node, const HeightGrid& grid, const Ground& ground) {
  MetadataSet set(graph);
  set.addText("crs", grid.crsCode);
  set.addText("crsName", grid.crsName);
  set.addText("wkt", grid.wkt);
  if (grid.transform)
    set.add("MetadataDouble", "geoTransform", fmt::format("{}", fmt::join(*grid.transform, " ")));
  set.add("MetadataInteger", "cells", fmt::format("{} {}", grid.columns, grid.rows));
  set.add("MetadataDouble", "origin", fmt::format("{} {}", ground.origin.x, ground.origin.y));
  set.add("MetadataDouble", "metresPerUnit", fmt::format("{} {}", ground.metresPerUnit.x, ground.metresPerUnit.y));
  set.add("MetadataDouble", "metresPerHeight", fmt::format("{}", ground.metresPerHeight));
  set.addText("heightUnit", grid.heightUnit);
  if (grid.noData && std::isfinite(*grid.noData))
    set.add("MetadataDouble", "noData", fmt::format("{}", *grid.noData));
  set.addTo(node, georeferenceName);
}

} // namespace imgeo
