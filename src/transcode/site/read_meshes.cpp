#include "transcode/site/read_meshes.h"

#include "base/error.h"
#include "base/file.h"
#include "base/narrow.h"
#include "base/parallel.h"
#include "containers/container_reader.h"
#include "containers/stored.h"
#include "prepare/weld.h"

#include <algorithm>
#include <limits>

namespace imgeo {

namespace {

/// The kind of element that all draws of a geometry have.
Topology topologyOf(const GeometryDescription& geometry, const std::string& location) {
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

Mesh readMesh(const ContainerReader& reader, const GeometryDescription& geometry, const std::string& location) {
  std::vector<IndexedPatch> patches(geometry.patches.size());
  parallelFor(patches.size(), [&](std::size_t i) { patches[i] = reader.decode(geometry.patches[i], geometry); });
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

} // namespace

Scene readMeshes(const SiteDocument& document) {
  Scene scene;
  scene.graph = document.scene.graph;
  std::vector<bool> isEmpty;
  const std::string location = (document.root / document.name).string();
  const ContainerReader reader(fetchFrom(document));
  for (const GeometryDescription& geometry : document.scene.geometries) {
    scene.meshes.push_back(readMesh(reader, geometry, location));
    isEmpty.push_back(scene.meshes.back().corners.empty());
  }
  for (const std::size_t node : shapeNodes(scene.graph)) {
    Mesh& mesh = scene.meshes[shapeOf(scene.graph, node).mesh];
    if (mesh.name.empty())
      mesh.name = scene.graph.nodes[node].name;
  }
  removeShapes(scene.graph, isEmpty);
  if (shapeNodes(scene.graph).empty())
    throw Error(ErrorKind::malformed, location, "draws nothing");
  return scene;
}

} // namespace imgeo
