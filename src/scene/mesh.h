#pragma once
// A mesh in memory: corners -> wedges -> positions.
//
// A corner is one corner of one element (triangle, line, point). It names a
// wedge: one combination of position and attributes (normal, colour ...). A
// wedge names its position. A crease or a texture seam is one position with
// several wedges, never two positions: connectivity stays what the shape is
// (`compact` needs that; classic and BG split wedges into vertices when they write).

#include "base/vec.h"
#include "scene/vertex_attributes.h"

#include <cassert>
#include <cstdint>
#include <string>
#include <vector>

namespace imgeo {

/// What an element is. The value is its number of corners.
enum class Topology : std::uint8_t { points = 1, lines = 2, triangles = 3 };

inline constexpr std::uint32_t cornersPerElement(Topology topology) {
  return static_cast<std::uint32_t>(topology);
}

inline constexpr Topology allTopologies[] = {Topology::triangles, Topology::lines, Topology::points};

/// "points", "lines", "triangles".
const char* nameOf(Topology topology);

/// How many elements there are of each kind.
struct ElementCounts {
  std::size_t triangles = 0, lines = 0, points = 0;

  std::size_t& of(Topology topology) {
    return topology == Topology::triangles ? triangles : topology == Topology::lines ? lines : points;
  }
  std::size_t of(Topology topology) const { return ElementCounts(*this).of(topology); }
  std::size_t sum() const { return triangles + lines + points; }
  ElementCounts& operator+=(const ElementCounts& other);
  friend bool operator==(const ElementCounts&, const ElementCounts&) = default;
};

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
