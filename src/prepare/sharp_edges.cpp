#include "prepare/sharp_edges.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace imgeo {

namespace {

/// About the most vertices at which edges are looked at, at equal distances in the order of the mesh.
constexpr std::size_t sampledVertices = 4096;
/// Fans of more triangles are left out.
constexpr std::size_t maxTriangles = 64;
constexpr double flatDegrees = 1;

struct EdgeCounts {
  std::size_t all = 0, flat = 0, curved = 0, sharp = 0;

  void add(double degrees) {
    ++all;
    flat += degrees < flatDegrees;
    curved += degrees > manMadeCreaseDegrees / 3 && degrees <= manMadeCreaseDegrees;
    sharp += degrees > manMadeCreaseDegrees;
  }
};

double degreesBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// Adds the edges of two triangles each from the position of `corners` to others.
void addEdges(const Mesh& mesh, std::span<const std::uint32_t> corners, EdgeCounts& counts) {
  struct Edge {
    std::uint32_t end;
    Vec3d normal; ///< of its triangle
  };
  std::vector<Edge> edges;
  for (const std::uint32_t corner : corners) {
    const std::uint32_t first = corner - corner % 3;
    const std::uint32_t next = first + (corner + 1) % 3, previous = first + (corner + 2) % 3;
    const Vec3d here(mesh.cornerPosition(corner));
    const Vec3d normal = cross(Vec3d(mesh.cornerPosition(next)) - here, Vec3d(mesh.cornerPosition(previous)) - here);
    if (length(normal) == 0)
      continue;
    for (const std::uint32_t other : {next, previous})
      edges.push_back({mesh.wedgePositions[mesh.corners[other]], normal});
  }
  std::ranges::stable_sort(edges, {}, &Edge::end);
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& edge) { return edge.end != begin->end; });
    if (end - begin == 2)
      counts.add(degreesBetween(begin[0].normal, begin[1].normal));
    begin = end;
  }
}

/// By sampled vertex: its corners.
std::vector<std::vector<std::uint32_t>> sampledFans(const Mesh& mesh) {
  const std::size_t step = std::max<std::size_t>(1, mesh.positions.size() / sampledVertices);
  std::vector<std::vector<std::uint32_t>> fans((mesh.positions.size() + step - 1) / step);
  for (std::uint32_t corner = 0; corner < mesh.corners.size(); ++corner)
    if (const std::uint32_t position = mesh.wedgePositions[mesh.corners[corner]]; position % step == 0)
      fans[position / step].push_back(corner);
  return fans;
}

} // namespace

bool isManMade(const Mesh& mesh) {
  assert(mesh.topology == Topology::triangles);
  EdgeCounts counts;
  for (const std::vector<std::uint32_t>& corners : sampledFans(mesh))
    if (corners.size() <= maxTriangles)
      addEdges(mesh, corners, counts);
  return counts.sharp > 0 && 4 * counts.flat >= counts.all && counts.sharp >= counts.curved;
}

} // namespace imgeo
