#include "transcode/encode/height_map.h"

#include "base/narrow.h"
#include "containers/classic/classic.h"
#include "containers/grid.h"
#include "containers/limits.h"
#include "containers/option_checks.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/height_field.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
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
  if (std::max(field.columns, field.rows) > guaranteedImageEdge)
    refuseOption("--as", fmt::format("{} has {} x {} heights, and images are at most {} wide and high", which,
                                     field.columns, field.rows, guaranteedImageEdge));
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

} // namespace

EncodedMesh encodeHeightMap(const Mesh& mesh, const ConvertOptions& options, ContentFiles& files) {
  const HeightField field = requiredHeightField(mesh);
  const Vec2<std::uint32_t> size{field.columns, field.rows};
  const Lattice lattice = heightMapLattice(decodeBoxOf(mesh), size, heightBits);
  Patch patch;
  static_cast<VertexAttributes&>(patch) = gather(mesh, field.wedges);
  patch.normals.clear();
  patch.positions = quantise(gather(mesh.positions, gather(mesh.wedgePositions, field.wedges)), lattice);

  PatchedMesh patched{lattice, boxOf(patch, lattice), {patch}};
  EncodedMesh result;
  const EncodeOptions encoding = encodeOptionsFrom(options);
  result.geometry = describe(patched, encoding);
  result.geometry.grid = GridKind::heightMap;
  result.geometry.indexType = ElementType::uint16; // there is no index
  IndexedPatch vertices;
  static_cast<VertexAttributes&>(vertices) = static_cast<const VertexAttributes&>(patch);
  vertices.positions = std::move(patch.positions);
  const EncodedPatch encoded = encodeGrids(vertices, field.columns, result.geometry, encoding);
  PatchDescription description = writePatch(encoded, files);
  description.box = boxOf(vertices.positions, result.geometry);
  description.vertexCount = narrow<std::uint32_t>(vertices.positions.size());
  description.implicitMeshSize = size;
  description.draws = {{Primitive::triangles, narrow<std::uint32_t>(3 * gridTriangleCount(GridKind::heightMap, size))}};
  result.vertices = description.vertexCount;
  result.elements.triangles = mesh.elementCount();
  noteAttributes(result, vertices, options);
  result.geometry.patches.push_back(std::move(description));
  result.positionError = positionErrorBound(result.geometry);
  return result;
}

} // namespace imgeo
