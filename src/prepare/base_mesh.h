#pragma once
// The base mesh of a patched mesh: a simplified mesh that is shown until patches arrive. It consists of one segment
// for each patch, which that patch replaces. Segments meet patches at their borders, vertex for vertex, so that no
// mixture of segments and patches has a crack that the mesh lacks.

#include "prepare/patches.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace imgeo {

/// The attributes belong to the wedges: all attributes that the patches have, except normals.
struct BaseMesh : VertexAttributes {
  std::vector<Vec3u> positions;              ///< on the patches' lattice, no two equal
  std::vector<std::uint32_t> wedgePositions; ///< wedge -> position; several wedges on a texture seam
  std::vector<std::uint32_t> corners;        ///< three wedges a triangle
  std::vector<std::uint32_t> segments;       ///< triangle -> segment, which is the index of the patch
  std::uint32_t segmentCount = 0;            ///< number of patches

  std::size_t triangleCount() const { return segments.size(); }
  const Vec3u& cornerPosition(std::size_t corner) const { return positions[wedgePositions[corners[corner]]]; }
};

/// Simplifies a mesh to about `percent` of its triangles, plus one triangle for each edge that two patches share: those
/// edges are kept. Returns nothing for 0 percent, and if a base mesh is not worth its bytes: for points and lines, for
/// fewer than `minTrianglesForBase` triangles, if it would have more than a fourth of the triangles (patches that are
/// nearly all border), or less than half of the area (unconnected triangles).
std::optional<BaseMesh> baseOf(const PatchedMesh& mesh, double percent);

/// Minimum number of triangles of a mesh that gets a base mesh. Smaller meshes arrive within a few round trips anyway.
inline constexpr std::size_t minTrianglesForBase = 10'000;

/// The triangles of a patch over lattice points, some of which may be equal.
struct PatchTriangles {
  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> corners;
};
PatchTriangles trianglesOf(const Patch& patch);

/// Whether every segment has the same border as its patch. Edges on the border of the whole mesh may differ, but the
/// segment may have no more of them than the patch.
bool meetsAtBorders(const BaseMesh& base, const std::vector<PatchTriangles>& patches);

} // namespace imgeo
