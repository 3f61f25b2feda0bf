#include "documents/grid_reader.h"

#include "containers/grid.h"
#include "containers/limits.h"
#include "documents/field_messages.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace imgeo {

Vec2<std::uint32_t> implicitMeshSizeOf(const FieldReader& fields, Vec2<std::uint32_t> fallback) {
  std::vector<double> size = fields.reals("implicitMeshSize", 2);
  if (size.empty())
    size = fields.reals("implicitMeshCount", 2); // the paper's name for it
  if (size.empty())
    return fallback;
  const auto whole = [&](double value) {
    if (value < 0 || value > 65536 || value != std::floor(value))
      fields.fail(ErrorKind::malformed, "implicitMeshSize is no size of an image");
    return static_cast<std::uint32_t>(value);
  };
  const std::uint32_t x = whole(size[0]), y = whole(size[1]);
  if (x == 0)
    fields.fail(ErrorKind::malformed, "implicitMeshSize has no columns");
  return {x, y == 0 ? x : y};
}

Vec2<std::uint32_t> gridOriginOf(const FieldReader& fields) {
  const std::vector<double> origin = fields.reals("gridOrigin", 2);
  if (origin.empty())
    return {};
  for (const double value : origin)
    if (!(value >= 0 && value < maxHeightMapEdge && value == std::floor(value)))
      fields.fail(ErrorKind::malformed, "gridOrigin is no column and row");
  return {static_cast<std::uint32_t>(origin[0]), static_cast<std::uint32_t>(origin[1])};
}

std::optional<GridKind> gridOf(const FieldReader& fields) {
  const std::string mode = fields.text("implicitMeshMode");
  for (const GridKind kind : {GridKind::heightMap, GridKind::geometryImage, GridKind::sculpt})
    if (equalIgnoringCase(mode, nameOf(kind)))
      return kind;
  if (!mode.empty() && !equalIgnoringCase(mode, "auto") && !equalIgnoringCase(mode, "sig"))
    failChoice(fields, "implicitMeshMode", std::array{"auto", "sig", "heightMap", "geometryImage", "sculpt"});
  return {};
}

namespace {

/// What a node states of the distance from its source.
std::optional<SurfaceDistance> surfaceDistanceOf(const FieldReader& fields) {
  const std::vector<double> distances = fields.reals("surfaceDistance", 2);
  if (distances.empty())
    return {};
  if (!(distances[0] >= 0 && distances[1] >= 0))
    fields.fail(ErrorKind::malformed, "surfaceDistance is no distance");
  return SurfaceDistance{distances[0], distances[1]};
}

/// Vertices and triangles of a patch follow from the size of its grid.
void describeGrid(const FieldReader& fields, GridKind kind, PatchDescription& patch) {
  const auto [columns, rows] = patch.implicitMeshSize;
  if (columns < 2 || rows < 2)
    fields.fail(ErrorKind::malformed,
                "a grid of " + std::to_string(columns) + " x " + std::to_string(rows) + " vertices has no surface");
  if (columns > maxImageEdge || rows > maxImageEdge)
    fields.fail(ErrorKind::limit, "a grid has more than " + std::to_string(maxImageEdge) + " columns or rows");
  patch.index.reset();
  patch.vertexCount = columns * rows;
  patch.draws = {{Primitive::triangles, static_cast<std::uint32_t>(3 * gridTriangleCount(kind, {columns, rows}))}};
}

} // namespace

void describeGrids(const FieldReader& fields, GeometryDescription& geometry) {
  geometry.surfaceDistance = surfaceDistanceOf(fields);
  for (PatchDescription& patch : geometry.patches)
    describeGrid(fields, *geometry.grid, patch);
  const Vec2<std::uint32_t> size = heightMapSize(geometry);
  if (geometry.grid == GridKind::heightMap && std::max(size.x, size.y) > maxHeightMapEdge)
    fields.fail(ErrorKind::limit,
                "a height map has more than " + std::to_string(maxHeightMapEdge) + " columns or rows");
}

} // namespace imgeo
