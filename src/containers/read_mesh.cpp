#include "containers/read_mesh.h"

#include "base/error.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/grid.h"
#include "containers/stored.h"
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

void append(Mesh& mesh, const IndexedPatch& patch, const Lattice& lattice, const std::string& location) {
  const std::size_t before = mesh.wedgeCount(), records = patch.vertexCount();
  if (before + records > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorKind::limit, location, "a shape has more vertices than 32 bits count");
  append(mesh, before, patch, records);
  for (const Vec3u& q : patch.positions) {
    mesh.wedgePositions.push_back(narrow<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(Vec3f(lattice.point(q)));
  }
  for (const std::uint32_t corner : cornersOf(patch, mesh.topology))
    mesh.corners.push_back(narrow<std::uint32_t>(before + corner));
}

} // namespace

Mesh readMesh(const ContainerReader& reader, const GeometryDescription& geometry, const std::string& location) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) {
    patches[i] = reader.decode(geometry.patches[i], geometry);
    if (geometry.grid && patches[i].normals.empty())
      patches[i].normals = slopeNormals(*geometry.grid, geometry.patches[i].implicitMeshSize, patches[i].positions,
                                        geometry.lattice, geometry.ccw);
  });
  Mesh mesh;
  mesh.topology = topologyOf(geometry, location);
  mesh.texCoordMappings = geometry.texCoordMappings;
  for (IndexedPatch& patch : patches)
    append(mesh, std::exchange(patch, {}), geometry.lattice, location);
  const bool isOpaque = std::ranges::all_of(mesh.colors, [](Rgba8 color) { return color.a == 255; });
  mesh.colorComponents = isOpaque ? 3 : 4;
  weld(mesh);
  return mesh;
}

} // namespace imgeo
