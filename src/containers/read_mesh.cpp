#include "containers/read_mesh.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/blur.h"
#include "containers/encodings.h"
#include "containers/flat_normals.h"
#include "containers/grid.h"
#include "containers/stored.h"
#include "containers/stored_coords.h"
#include "prepare/weld.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace imgeo {

namespace {

/// The kind of element that all draws of a geometry have.
Topology topologyOf(const GeometryDescription& geometry, const std::string& location) {
  if (geometry.topology)
    return *geometry.topology;
  std::optional<Topology> topology;
  for (const PatchDescription& patch : geometry.patches)
    for (const Draw& draw : patch.draws) {
      if (topology && *topology != topologyOf(draw.primitive))
        throw Error(ErrorKind::unsupported, location,
                    "a shape draws elements of several kinds (triangles, lines, points)");
      topology = topologyOf(draw.primitive);
    }
  return topology.value_or(Topology::triangles);
}

/// Vertex indices of the corners of a patch's elements.
std::vector<std::uint32_t> cornersOf(const IndexedPatch& patch, Topology topology) {
  std::vector<std::uint32_t> corners;
  switch (topology) {
  case Topology::triangles:
    for (const Vec3u& triangle : trianglesOf(patch))
      corners.insert(corners.end(), {triangle.x, triangle.y, triangle.z});
    break;
  case Topology::lines:
    for (const Vec2<std::uint32_t>& line : linesOf(patch))
      corners.insert(corners.end(), {line.x, line.y});
    break;
  case Topology::points:
    for (std::uint32_t n = 0, count = narrow<std::uint32_t>(drawnCount(patch.draws)); n < count; ++n)
      corners.push_back(patch.indices.empty() ? n : patch.indices[n]);
  }
  return corners;
}

/// A patch, and the points of its vertices.
struct DecodedPatch {
  IndexedPatch indexed;
  std::vector<Vec3d> points; ///< where they are no longer on the lattice
};

DecodedPatch decode(const ContainerReader& reader, const PatchDescription& patch, const GeometryDescription& geometry) {
  DecodedPatch decoded{reader.decode(patch, geometry), {}};
  IndexedPatch& indexed = decoded.indexed;
  const bool isBlurred = blurRadiusOf(geometry.operators) > 0;
  if (isBlurred)
    decoded.points = blurredPoints(indexed, patch, geometry, reader.fetch());
  if (geometry.grid && isBlurred)
    indexed.normals = slopeNormals(*geometry.grid, patch.implicitMeshSize, decoded.points, geometry.ccw);
  else if (geometry.grid && indexed.normals.empty())
    indexed.normals =
        slopeNormals(*geometry.grid, patch.implicitMeshSize, indexed.positions, geometry.lattice, geometry.ccw);
  return decoded;
}

void append(Mesh& mesh, const DecodedPatch& decoded, const Lattice& lattice, const std::string& location) {
  const IndexedPatch& patch = decoded.indexed;
  const std::size_t before = mesh.wedgeCount(), records = patch.vertexCount();
  if (before + records > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit, location, "a shape has more vertices than 32 bits count");
  append(mesh, before, patch, records);
  for (std::size_t i = 0; i < records; ++i) {
    mesh.wedgePositions.push_back(narrow<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(Vec3f(decoded.points.empty() ? lattice.point(patch.positions[i]) : decoded.points[i]));
  }
  for (const std::uint32_t corner : cornersOf(patch, mesh.topology))
    mesh.corners.push_back(narrow<std::uint32_t>(before + corner));
}

} // namespace

OperatorFrame operatorFrameOf(const GeometryDescription& geometry, const Mesh& mesh) {
  if (!hasElementTypes(geometry.encoding) || geometry.coordType != ElementType::float32) {
    const auto [position, size] = decodeFields(geometry);
    return OperatorFrame::of({position - size * 0.5, position + size * 0.5});
  }
  Box3d box;
  for (const PatchDescription& patch : geometry.patches) {
    const Box3d& stated = patch.box.empty() ? geometry.box : patch.box;
    if (stated.empty())
      return OperatorFrame::of(boxOf(mesh));
    box.add(stated.min);
    box.add(stated.max);
  }
  return OperatorFrame::of(box);
}

namespace {

/// The names of the sets of texture coordinates, without that of the images of levels, which is the last.
std::vector<std::string> sourceMappings(const GeometryDescription& geometry) {
  std::vector<std::string> names = geometry.texCoordMappings;
  if (const std::size_t set = geometry.levels ? geometry.levels->chipSet : 0; set > 0 && names.size() > set)
    names.resize(set);
  return names == std::vector<std::string>{""} ? std::vector<std::string>{} : names;
}

} // namespace

Mesh readMesh(const ContainerReader& reader, const GeometryDescription& stated, const std::string& location,
              bool keepsVertices) {
  GeometryDescription geometry = stated;
  geometry.lattice = reader.latticeOf(stated);
  std::vector<DecodedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = decode(reader, geometry.patches[i], geometry); });
  Mesh mesh;
  mesh.topology = topologyOf(geometry, location);
  mesh.texCoordMappings = sourceMappings(geometry);
  for (DecodedPatch& patch : patches)
    append(mesh, std::exchange(patch, {}), geometry.lattice, location);
  const bool isOpaque = std::ranges::all_of(mesh.colors, [](const Rgba& color) { return color.a == 1; });
  mesh.colorComponents = isOpaque ? 3 : 4;
  if (!keepsVertices)
    weld(mesh);
  applyOperators(mesh, geometry.operators, operatorFrameOf(geometry, mesh), location);
  if (geometry.isFlat && mesh.topology == Topology::triangles) {
    makeFlat(mesh);
    weld(mesh);
  }
  return mesh;
}

} // namespace imgeo
