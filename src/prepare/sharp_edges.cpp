#include "prepare/sharp_edges.h"

#include "prepare/index_hash_table.h"

#include <algorithm>
#include <bit>
#include <numbers>
#include <span>
#include <tuple>

namespace imgeo {

namespace {

/// About the most vertices at which edges are looked at.
constexpr std::uint64_t sampledVertices = 4096;
/// Meshes of which more corners are sampled have many triangles around single vertices, and are not man-made.
constexpr std::size_t maxCorners = std::size_t{1} << 18;
/// Fans of more triangles are left out.
constexpr std::size_t maxTriangles = 64;
constexpr double flatDegrees = 1, minCurvedDegrees = 19;

struct EdgeCounts {
  std::size_t all = 0, flat = 0, curved = 0, sharp = 0;

  void add(double degrees) {
    ++all;
    flat += degrees < flatDegrees;
    curved += degrees > minCurvedDegrees && degrees <= manMadeCreaseDegrees;
    sharp += degrees > manMadeCreaseDegrees;
  }
};

auto orderOf(const Vec3f& position) {
  return std::tuple(position.x, position.y, position.z);
}

/// Equal for equal positions, of which 0 and -0 are one.
std::uint64_t hashOf(const Vec3f& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis)
    hash = mixHash(hash, std::bit_cast<std::uint32_t>(position[axis] + 0.0f));
  return hash;
}

double degreesBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

/// Adds the edges of two triangles each from the first position of `corners`, which all have, to others.
void addEdges(std::span<const CornerTriangle> corners, EdgeCounts& counts) {
  struct Edge {
    Vec3f end;
    Vec3d normal; ///< of its triangle
  };
  std::vector<Edge> edges;
  for (const auto& [here, next, previous] : corners) {
    const Vec3d normal = cross(Vec3d(next) - Vec3d(here), Vec3d(previous) - Vec3d(here));
    if (length(normal) == 0)
      continue;
    for (const Vec3f& end : {next, previous})
      edges.push_back({end, normal});
  }
  std::ranges::stable_sort(edges, {}, [](const Edge& edge) { return orderOf(edge.end); });
  for (auto begin = edges.begin(); begin != edges.end();) {
    const auto end = std::find_if(begin, edges.end(), [&](const Edge& edge) { return edge.end != begin->end; });
    if (end - begin == 2)
      counts.add(degreesBetween(begin[0].normal, begin[1].normal));
    begin = end;
  }
}

} // namespace

std::vector<CornerTriangle> sampledCorners(const Mesh& mesh, std::uint64_t triangles) {
  assert(mesh.topology == Topology::triangles);
  const std::uint64_t step = std::max<std::uint64_t>(1, triangles / (2 * sampledVertices)); // two triangles a vertex
  std::vector<bool> isSampled;
  isSampled.reserve(mesh.positions.size());
  for (const Vec3f& position : mesh.positions)
    isSampled.push_back(hashOf(position) % step == 0);
  std::vector<CornerTriangle> corners;
  for (std::uint32_t corner = 0; corner < mesh.corners.size() && corners.size() <= maxCorners; ++corner) {
    if (!isSampled[mesh.wedgePositions[mesh.corners[corner]]])
      continue;
    const std::uint32_t first = corner - corner % 3;
    corners.push_back({mesh.cornerPosition(corner), mesh.cornerPosition(first + (corner + 1) % 3),
                       mesh.cornerPosition(first + (corner + 2) % 3)});
  }
  return corners;
}

void appendSampledCorners(std::vector<CornerTriangle>& corners, const std::vector<CornerTriangle>& next) {
  if (corners.size() <= maxCorners)
    corners.insert(corners.end(), next.begin(), next.end());
}

bool isManMade(std::vector<CornerTriangle> corners) {
  if (corners.size() > maxCorners)
    return false;
  std::ranges::sort(corners, {}, [](const CornerTriangle& triangle) { return orderOf(triangle[0]); });
  EdgeCounts counts;
  for (auto begin = corners.begin(); begin != corners.end();) {
    const auto end = std::find_if(begin, corners.end(), [&](const auto& other) { return other[0] != (*begin)[0]; });
    if (static_cast<std::size_t>(end - begin) <= maxTriangles)
      addEdges({begin, end}, counts);
    begin = end;
  }
  const bool hasPlanes = 4 * counts.flat >= counts.all, isSolid = 16 * (counts.flat + counts.sharp) >= 15 * counts.all;
  return counts.sharp > 0 && counts.sharp >= counts.curved && (hasPlanes || isSolid);
}

bool isManMade(const Mesh& mesh) {
  return isManMade(sampledCorners(mesh, mesh.elementCount()));
}

} // namespace imgeo
