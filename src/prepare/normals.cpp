// Normals of vertices are weighted sums of those of the triangles around them. Weights: Gouraud, "Continuous shading of
// curved surfaces", 1971 (uniform); Thürmer and Wüthrich, "Computing vertex normals from polygonal facets", 1998
// (angle). Normals are divided at creases as X3D's creaseAngle asks (ISO/IEC 19775-1, 11.2.3).

#include "prepare/normals.h"

#include "base/disjoint_sets.h"
#include "base/parallel.h"
#include "prepare/incidence.h"
#include "prepare/weld.h"

#include <algorithm>
#include <numbers>
#include <numeric>

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

Vec3f unitOf(const Vec3d& sum) {
  const double size = length(sum);
  return size > 0 ? Vec3f(sum * (1 / size)) : Vec3f{0, 0, 1};
}

Incidence cornersByPosition(const Mesh& mesh) {
  return incidenceOf(mesh.corners.size(), mesh.positions.size(),
                     [&](std::size_t corner) { return mesh.wedgePositions[mesh.corners[corner]]; });
}

/// One normal for each position, by wedge. Each sum is gathered by position, not scattered by triangle, so that its
/// order, and with it its last bit, does not depend on threads.
std::vector<Vec3f> smoothNormals(const Mesh& mesh, NormalWeighting weighting) {
  const Incidence incidence = cornersByPosition(mesh);
  std::vector<Vec3f> normals(mesh.positions.size());
  parallelForBlocks(normals.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t position = begin; position < end; ++position) {
      Vec3d sum;
      for (const std::uint32_t corner : incidence.of(static_cast<std::uint32_t>(position)))
        sum += contribution(mesh, corner, weighting);
      normals[position] = unitOf(sum);
    }
  });
  return gather(normals, mesh.wedgePositions);
}

/// The corners around a position, divided at creases and at the ends of the surface.
class Fans {
public:
  explicit Fans(const Mesh& mesh)
      : mesh_(mesh), minCosine_(std::cos(mesh.creaseDegrees.value_or(smoothDegrees) * std::numbers::pi / 180) - 1e-9) {}

  /// By corner of `corners`, which lie at one position: the number, below their count, of its fan.
  const std::vector<std::uint32_t>& of(std::span<const std::uint32_t> corners) {
    edges_.clear(), facets_.clear();
    for (std::uint32_t i = 0; i < corners.size(); ++i) {
      const std::uint32_t first = corners[i] - corners[i] % 3;
      facets_.push_back(unitNormal(corners[i]));
      for (const std::uint32_t step : {1u, 2u})
        edges_.push_back({mesh_.wedgePositions[mesh_.corners[first + (corners[i] + step) % 3]], i});
    }
    std::ranges::sort(edges_);
    DisjointSets sets(corners.size());
    for (auto begin = edges_.begin(); begin != edges_.end();) {
      const auto end = std::find_if(begin, edges_.end(), [&](const Edge& edge) { return edge.end != begin->end; });
      if (end - begin <= maxTriangles)
        for (auto a = begin; a != end; ++a)
          for (auto b = a + 1; b != end; ++b)
            if (dot(facets_[a->corner], facets_[b->corner]) >= minCosine_)
              sets.merge(a->corner, b->corner);
      begin = end;
    }
    fans_.resize(corners.size());
    for (std::uint32_t i = 0; i < corners.size(); ++i)
      fans_[i] = sets.find(i);
    return fans_;
  }

private:
  /// An edge from the position to another one, of the triangle of a corner.
  struct Edge {
    std::uint32_t end;
    std::uint32_t corner; ///< its index in `corners`

    auto operator<=>(const Edge&) const = default;
  };

  /// Pairs of the triangles around an edge are compared; damaged files may have thousands.
  static constexpr std::ptrdiff_t maxTriangles = 16;

  Vec3d unitNormal(std::uint32_t corner) const {
    const Vec3d normal = contribution(mesh_, corner - corner % 3, NormalWeighting::area);
    const double size = length(normal);
    return size > 0 ? normal * (1 / size) : Vec3d();
  }

  const Mesh& mesh_;
  double minCosine_;
  std::vector<Edge> edges_;
  std::vector<Vec3d> facets_;
  std::vector<std::uint32_t> fans_;
};

/// One normal for each fan, by corner.
std::vector<Vec3f> creaseNormals(const Mesh& mesh, NormalWeighting weighting) {
  const Incidence incidence = cornersByPosition(mesh);
  std::vector<Vec3f> normals(mesh.corners.size());
  parallelForBlocks(mesh.positions.size(), [&](std::size_t begin, std::size_t end) {
    Fans fans(mesh);
    std::vector<Vec3d> sums;
    for (std::size_t position = begin; position < end; ++position) {
      const std::span<const std::uint32_t> corners = incidence.of(static_cast<std::uint32_t>(position));
      const std::vector<std::uint32_t>& fanOf = fans.of(corners);
      sums.assign(corners.size(), Vec3d());
      for (std::size_t i = 0; i < corners.size(); ++i)
        sums[fanOf[i]] += contribution(mesh, corners[i], weighting);
      for (std::size_t i = 0; i < corners.size(); ++i)
        normals[corners[i]] = unitOf(sums[fanOf[i]]);
    }
  });
  return normals;
}

/// Gives each corner a wedge of its own.
void separateCorners(Mesh& mesh) {
  static_cast<VertexAttributes&>(mesh) = gather(mesh, mesh.corners);
  mesh.wedgePositions = gather(mesh.wedgePositions, mesh.corners);
  std::iota(mesh.corners.begin(), mesh.corners.end(), 0u);
}

} // namespace

void computeNormals(Mesh& mesh, NormalWeighting weighting) {
  assert(mesh.topology == Topology::triangles);
  if (mesh.creaseDegrees.value_or(smoothDegrees) >= smoothDegrees) {
    mesh.normals = smoothNormals(mesh, weighting);
    return;
  }
  std::vector<Vec3f> normals = creaseNormals(mesh, weighting);
  mesh.normals.clear();
  separateCorners(mesh);
  mesh.normals = std::move(normals);
  weld(mesh);
}

} // namespace imgeo
