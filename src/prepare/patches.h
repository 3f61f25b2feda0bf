#pragma once
// Patches: a mesh on its lattice, cut by a KD tree into pieces that a container
// can hold (paper 5.5: "simple KD trees to collect triangles in a minimal
// bounding box").

#include "prepare/lattice.h"
#include "scene/mesh.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// Corners and wedges of a patch at most: the texels of the largest image (2048 x
/// 2048) that every WebGL 2 allows.
inline constexpr std::uint32_t maxPatchCorners = 2048 * 2048, maxPatchWedges = 2048 * 2048;

/// A piece of a mesh: the same corner -> wedge -> position structure, positions
/// on the lattice. Positions on a border stand in each patch that touches them.
struct Patch : VertexAttributes {
  Topology topology = Topology::triangles;
  std::vector<Vec3u> positions;
  std::vector<std::uint32_t> wedgePositions;
  std::vector<std::uint32_t> corners;

  std::size_t wedgeCount() const { return wedgePositions.size(); }
  std::size_t elementCount() const { return corners.size() / cornersPerElement(topology); }
};

struct PatchedMesh {
  Lattice lattice;
  Box3d box;                  ///< tight, of the quantised mesh
  std::vector<Patch> patches; ///< in KD order: neighbours in space are near in the list
};

/// A patch's tight box, in the mesh's units.
Box3d boxOf(const Patch& patch, const Lattice& lattice);

/// Cuts `mesh`, all of whose wedges and positions are in use, so that no patch has more than
/// `maxWedges` wedges (3 .. maxPatchWedges) or more than `maxPatchCorners` corners. Every
/// element is in exactly one patch, in an order that depends on the input alone, not on threads.
PatchedMesh cutIntoPatches(Mesh mesh, const Lattice& lattice, std::uint32_t maxWedges);
/// The same where the mesh's positions on the lattice are known.
PatchedMesh cutIntoPatches(Mesh mesh, std::vector<Vec3u> points, const Lattice& lattice, std::uint32_t maxWedges);

} // namespace imgeo
