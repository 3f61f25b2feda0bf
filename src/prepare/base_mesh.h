#pragma once
// A mesh of few triangles that stands in for the patches of another until they are
// there, each patch's part for itself. The parts meet whole patches at their
// borders, vertex for vertex, so that no mixture of both has a crack that the
// mesh has not.

#include "prepare/patches.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace imgeo {

/// The attributes are those of its wedges, as far as the patches have them, but for normals.
struct BaseMesh : VertexAttributes {
  std::vector<Vec3u> positions;              ///< on the patches' lattice, no two alike
  std::vector<std::uint32_t> wedgePositions; ///< wedge -> position; several where the texture has a seam
  std::vector<std::uint32_t> corners;        ///< three wedges a triangle
  std::vector<std::uint32_t> segments;       ///< per triangle: the patch that it stands in for
  std::uint32_t segmentCount = 0;            ///< patches

  std::size_t triangleCount() const { return segments.size(); }
  const Vec3u& cornerPosition(std::size_t corner) const { return positions[wedgePositions[corners[corner]]]; }
};

/// A mesh of about `percent` of the triangles, and one for each edge at which patches
/// meet, as those edges stay. Nothing where no base is worth its bytes: for points
/// and lines, for fewer than `minTrianglesForBase`, where it would have more than a
/// fourth of the triangles (patches that are nearly all border), and where less than
/// half of the area is left (loose triangles).
std::optional<BaseMesh> baseOf(const PatchedMesh& mesh, double percent);

/// The bytes of fewer arrive within the first few round trips anyway.
inline constexpr std::size_t minTrianglesForBase = 10'000;

/// The triangles of a patch over lattice points, of which some may be alike.
struct PatchTriangles {
  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> corners;
};
PatchTriangles trianglesOf(const Patch& patch);

/// Whether every part has the same border as its patch, but for edges that are a
/// border of the whole mesh: those of the patch may have become others, and no more.
bool meetsAtBorders(const BaseMesh& base, const std::vector<PatchTriangles>& patches);

} // namespace imgeo
