#pragma once
// Patches: pieces of a quantised mesh that are small enough for a container. A KD tree divides the mesh (paper 5.5:
// "simple KD trees to collect triangles in a minimal bounding box").

#include "prepare/lattice.h"
#include "prepare/vertex_grid.h"
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// Maximum number of corners and of wedges of a patch: the texels of an image of 2048 x 2048, the maximum texture size
/// that every WebGL 2 implementation supports.
inline constexpr std::uint32_t maxPatchCorners = 2048 * 2048, maxPatchWedges = 2048 * 2048;

/// A piece of a mesh, with the mesh's structure corner -> wedge -> position and positions on the lattice. Each patch
/// has its own copy of the positions on its border.
struct Patch : VertexAttributes {
  Topology topology = Topology::triangles;
  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> wedgePositions;
  std::vector<std::uint32_t> corners;
  /// The grid of the whole mesh, of at most 16 bits, if it is cut into several patches: one alone has fewer lines to
  /// find it by.
  std::optional<VertexGrid> grid{};

  std::size_t wedgeCount() const { return wedgePositions.size(); }
  std::size_t elementCount() const { return corners.size() / cornersPerElement(topology); }
};

struct PatchedMesh {
  Lattice lattice;
  Box3d box;                  ///< tight bounding box of the quantised mesh
  std::vector<Patch> patches; ///< in the order of the KD tree's leaves: neighbours in space are close in the list
};

/// The tight bounding box of a patch, in the mesh's units.
Box3d boxOf(const Patch& patch, const Lattice& lattice);

/// Divides `mesh`, which has no unused wedges and positions, into patches of at most `maxWedges` wedges (3 ..
/// maxPatchWedges) and at most `maxPatchCorners` corners. Every element is in exactly one patch. The order does not
/// depend on threads.
PatchedMesh cutIntoPatches(Mesh mesh, const Lattice& lattice, std::uint32_t maxWedges);
/// The same for a mesh that has been quantised: `points` are its positions on the lattice.
PatchedMesh cutIntoPatches(Mesh mesh, std::vector<Vec3u> points, const Lattice& lattice, std::uint32_t maxWedges);

} // namespace imgeo
