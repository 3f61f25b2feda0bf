#pragma once
// A mesh in memory: corners index wedges, which index positions.
//
// A corner is a corner of an element (triangle, line, point). It refers to a wedge, which is a combination of a
// position and attributes (normal, colour ...). A wedge refers to its position. A position on a crease or a texture
// seam has several wedges, so that the connectivity is that of the surface. `compact` encodes this connectivity; the
// writers of classic and BG make each wedge a vertex.

#include "base/vec.h"
#include "imgeo/elements.h"
#include "imgeo/preparation.h"
#include "scene/vertex_attributes.h"

#include <cassert>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// The crease angle of meshes without creases.
inline constexpr double smoothDegrees = 180;

/// A mesh. The attributes belong to the wedges.
struct Mesh : VertexAttributes {
  std::string name; ///< name of the source's node or file; may be empty
  Topology topology = Topology::triangles;
  std::vector<Vec3f> positions;              ///< in the source's units, finite
  std::vector<std::uint32_t> wedgePositions; ///< wedge -> position
  std::vector<std::uint32_t> corners;        ///< corner -> wedge, cornersPerElement(topology) for each element
  /// Edges at which triangles meet at a larger angle are sharp, where the mesh has no normals. Nothing: the source says
  /// nothing, and the shape decides (prepare/sharp_edges.h). 0: all triangles are flat.
  std::optional<double> creaseDegrees = smoothDegrees;

  std::size_t wedgeCount() const { return wedgePositions.size(); }
  std::size_t elementCount() const { return corners.size() / cornersPerElement(topology); }
  const Vec3f& cornerPosition(std::size_t corner) const { return positions[wedgePositions[corners[corner]]]; }
};

/// The tight bounding box of the positions.
Box3d boxOf(const Mesh& mesh);

/// Whether a mesh keeps its invariants: each attribute is empty or has one value for each wedge, indices are in range,
/// corners form whole elements. For assertions and tests.
bool isConsistent(const Mesh& mesh);

} // namespace imgeo
