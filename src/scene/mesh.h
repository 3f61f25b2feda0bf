#pragma once
// A mesh in memory: corners -> wedges -> positions.
//
// A corner is one corner of one element (triangle, line, point). It names a
// wedge: one combination of position and attributes (normal, colour ...). A
// wedge names its position. A crease or a texture seam is one position with
// several wedges, never two positions: connectivity stays what the shape is
// (`compact` needs that; classic and BG split wedges into vertices when they write).

#include "base/vec.h"
#include "imgeo/elements.h"
#include "scene/vertex_attributes.h"

#include <cassert>
#include <cstdint>
#include <string>
#include <vector>

namespace imgeo {

/// The attributes are those of its wedges.
struct Mesh : VertexAttributes {
  std::string name; ///< of the source's node or file; may be empty
  Topology topology = Topology::triangles;
  std::vector<Vec3f> positions;              ///< in the source's units, finite
  std::vector<std::uint32_t> wedgePositions; ///< wedge -> position
  std::vector<std::uint32_t> corners;        ///< corner -> wedge, cornersPerElement(topology) an element

  std::size_t wedgeCount() const { return wedgePositions.size(); }
  std::size_t elementCount() const { return corners.size() / cornersPerElement(topology); }
  const Vec3f& cornerPosition(std::size_t corner) const { return positions[wedgePositions[corners[corner]]]; }
};

/// The tight box of the positions.
Box3d boxOf(const Mesh& mesh);

/// Asserts what every Mesh keeps: attributes are empty or one a wedge, indices
/// are in range, corners are whole elements. For tests and for the ends of stages.
bool isConsistent(const Mesh& mesh);

} // namespace imgeo
