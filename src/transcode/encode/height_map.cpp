#include "transcode/encode/height_map.h"

#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/classic/classic.h"
#include "containers/grid.h"
#include "containers/limits.h"
#include "containers/normals.h"
#include "containers/option_checks.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/grid_parts.h"
#include "prepare/height_field.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint32_t heightBits = 16;

HeightField requiredHeightField(const Mesh& mesh) {
  auto found = heightFieldOf(mesh);
  const std::string which = mesh.name.empty() ? "a mesh" : fmt::format("the mesh \"{}\"", mesh.name);
  if (const std::string* lack = std::get_if<std::string>(&found))
    refuseOption("--as", fmt::format("{} is no height map: {}", which, *lack));
  HeightField field = std::get<HeightField>(std::move(found));
  if (std::max(field.columns, field.rows) > maxHeightMapEdge)
    refuseOption("--as", fmt::format("{} has {} x {} heights, and height maps have at most {} columns and rows", which,
                                     field.columns, field.rows, maxHeightMapEdge));
  return field;
}

/// The decode box of a mesh. A step of the heights is one unit if all are whole; otherwise the 16 bits cover them.
DecodeFields decodeBoxOf(const Mesh& mesh) {
  constexpr double maxHeight = (1 << heightBits) - 1;
  Box3d box = boxOf(mesh);
  const bool areWhole = std::ranges::all_of(mesh.positions, [](Vec3f p) { return p.y == std::round(p.y); });
  if (areWhole && box.size().y <= maxHeight)
    box.max.y = box.min.y + maxHeight;
  else if (box.size().y == 0)
    box.max.y += 1;
  return {box.center(), box.size()};
}

/// The parts as patches without corners. Normals are kept where there are several parts: at their borders slopes do not
/// say enough.
PatchedMesh patchesOf(const Mesh& mesh, const HeightField& field, const std::vector<GridPart>& parts) {
  PatchedMesh patched;
  patched.lattice = heightMapLattice(decodeBoxOf(mesh), {field.columns, field.rows}, heightBits);
  for (const GridPart& part : parts) {
    const std::vector<std::uint32_t> wedges = gather(field.wedges, verticesOf(part, field.columns));
    Patch patch;
    static_cast<VertexAttributes&>(patch) = gather(mesh, wedges);
    if (parts.size() == 1)
      patch.normals.clear();
    patch.positions = quantise(gather(mesh.positions, gather(mesh.wedgePositions, wedges)), patched.lattice);
    const Box3d box = boxOf(patch, patched.lattice);
    patched.box.add(box.min);
    patched.box.add(box.max);
    patched.patches.push_back(std::move(patch));
  }
  return patched;
}

PatchDescription writePart(Patch patch, const GridPart& part, const GeometryDescription& geometry,
                           const EncodeOptions& options, ContentFiles& files) {
  IndexedPatch vertices;
  static_cast<VertexAttributes&>(vertices) = std::move(static_cast<VertexAttributes&>(patch));
  vertices.positions = std::move(patch.positions);
  PatchDescription description = writePatch(encodeGrids(vertices, part.size.x, geometry, options), files);
  description.box = boxOf(vertices.positions, geometry);
  description.vertexCount = narrow<std::uint32_t>(vertices.positions.size());
  description.implicitMeshSize = part.size;
  description.gridOrigin = part.origin;
  description.draws = {
      {Primitive::triangles, narrow<std::uint32_t>(3 * gridTriangleCount(GridKind::heightMap, part.size))}};
  return description;
}

} // namespace

EncodedMesh encodeHeightMap(const Mesh& mesh, const ConvertOptions& options, ContentFiles& files) {
  const HeightField field = requiredHeightField(mesh);
  const std::vector<GridPart> parts = gridParts({field.columns, field.rows}, options.gridImageEdge);
  PatchedMesh patched = patchesOf(mesh, field, parts);
  EncodedMesh result;
  const EncodeOptions encoding = encodeOptionsFrom(options);
  result.geometry = describe(patched, encoding);
  result.geometry.grid = GridKind::heightMap;
  result.geometry.indexType = ElementType::uint16; // there is no index
  for (const Patch& patch : patched.patches)
    noteAttributes(result, patch, options);
  std::vector<PatchDescription> descriptions(parts.size());
  parallelFor(parts.size(), [&](std::size_t i) {
    descriptions[i] = writePart(std::exchange(patched.patches[i], {}), parts[i], result.geometry, encoding, files);
  });
  for (const PatchDescription& description : descriptions)
    result.vertices += description.vertexCount;
  result.elements.triangles = mesh.elementCount();
  result.geometry.patches = std::move(descriptions);
  if (result.hasNormals)
    result.normalErrorDegrees = normalErrorBound(result.geometry) * (180 / std::numbers::pi);
  result.positionError = positionErrorBound(result.geometry);
  return result;
}

} // namespace imgeo
