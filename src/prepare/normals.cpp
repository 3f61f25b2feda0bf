// Normals of vertices are weighted sums of those of the triangles around them. Weights: Gouraud, "Continuous shading of
// curved surfaces", 1971 (uniform); Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998
// (angle).

#include "prepare/normals.h"

#include "base/parallel.h"
#include "prepare/incidence.h"

namespace imgeo {

namespace {

/// The weighted normal of a corner's triangle, which is added to the normal of the corner's position.
Vec3d contribution(const Mesh& mesh, std::uint32_t corner, NormalWeighting weighting) {
  const std::uint32_t first = corner - corner % 3;
  const Vec3d here(mesh.cornerPosition(corner));
  const Vec3d next = Vec3d(mesh.cornerPosition(first + (corner + 1) % 3)) - here;
  const Vec3d previous = Vec3d(mesh.cornerPosition(first + (corner + 2) % 3)) - here;
  const Vec3d normal = cross(next, previous);
  const double doubleArea = length(normal);
  if (weighting == NormalWeighting::area || doubleArea == 0)
    return normal;
  if (weighting == NormalWeighting::uniform)
    return normal * (1 / doubleArea);
  return normal * (std::atan2(doubleArea, dot(next, previous)) / doubleArea);
}

} // namespace

void computeNormals(Mesh& mesh, NormalWeighting weighting) {
  assert(mesh.topology == Topology::triangles);
  const Incidence incidence = incidenceOf(mesh.corners.size(), mesh.positions.size(), [&](std::size_t corner) {
    return mesh.wedgePositions[mesh.corners[corner]];
  });

  // Each sum is gathered by position, not scattered by triangle, so that its order, and with it its last bit, does not
  // depend on threads.
  std::vector<Vec3f> normals(mesh.positions.size());
  parallelForBlocks(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t position = begin; position < end; ++position) {
      Vec3d sum;
      for (const std::uint32_t corner : incidence.of(static_cast<std::uint32_t>(position)))
        sum += contribution(mesh, corner, weighting);
      const double size = length(sum);
      normals[position] = size > 0 ? Vec3f(sum * (1 / size)) : Vec3f{0, 0, 1};
    }
  });

  mesh.normals.resize(mesh.wedgeCount());
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.normals[wedge] = normals[mesh.wedgePositions[wedge]];
}

} // namespace imgeo
