#include "containers/flat_normals.h"

#include "base/narrow.h"
#include "containers/stored.h"

#include <cassert>
#include <numeric>
#include <vector>

namespace imgeo {

namespace {

/// Replaces the attributes of vertices by those of the corners of triangles, with the normals of these.
template <typename PositionOf>
void gatherFlat(VertexAttributes& attributes, const std::vector<std::uint32_t>& corners, const PositionOf& positionOf) {
  std::vector<Vec3f> normals;
  normals.reserve(corners.size());
  for (std::size_t corner = 0; corner + 2 < corners.size(); corner += 3) {
    const Vec3d a = positionOf(corners[corner]), b = positionOf(corners[corner + 1]),
                c = positionOf(corners[corner + 2]), normal = cross(b - a, c - a);
    normals.insert(normals.end(), 3, unitNormal(length(normal) > 0 ? normal : Vec3d{0, 0, 1}));
  }
  attributes = gather(attributes, corners);
  attributes.normals = std::move(normals);
}

} // namespace

void makeFlat(Mesh& mesh) {
  assert(mesh.topology == Topology::triangles);
  gatherFlat(mesh, mesh.corners,
             [&](std::uint32_t wedge) { return Vec3d(mesh.positions[mesh.wedgePositions[wedge]]); });
  mesh.wedgePositions = gather(mesh.wedgePositions, mesh.corners);
  std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
}

void makeFlat(IndexedPatch& patch, const Lattice& lattice) {
  std::vector<std::uint32_t> corners;
  for (const Vec3u& triangle : trianglesOf(patch))
    corners.insert(corners.end(), {triangle.x, triangle.y, triangle.z});
  gatherFlat(patch, corners,
             [&](std::uint32_t vertex) { return Vec3d(Vec3f(lattice.point(patch.positions[vertex]))); });
  patch.positions = gather(patch.positions, corners);
  patch.indices.resize(corners.size());
  std::iota(patch.indices.begin(), patch.indices.end(), 0u);
  patch.draws = {{Primitive::triangles, narrow<std::uint32_t>(corners.size())}};
  patch.ccw = true; // trianglesOf() has turned the others round
}

} // namespace imgeo
