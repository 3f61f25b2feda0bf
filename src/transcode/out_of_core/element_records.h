#pragma once
// Triangles and points in work files: records of a tag, the positions of the corners and their attributes.

#include "scene/mesh.h"

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// What records have: corners, and which attributes these have. Records are runs of floats.
struct RecordLayout {
  Topology topology = Topology::triangles; ///< or points, of which each is one corner
  bool normals = false, colors = false;
  std::uint32_t texCoordSets = 0;
  std::vector<std::string> texCoordMappings; ///< names of the sets; may be empty
  std::uint32_t colorComponents = 3;         ///< not a difference between layouts: chunks without transparency have 3
  std::vector<NamedAttribute> named;         ///< without values

  static RecordLayout of(const Mesh& mesh);
  bool hasSameAttributes(const RecordLayout& other) const;
  std::size_t corners() const { return cornersPerElement(topology); }
  std::size_t cornerFloats() const;
  std::size_t attributesOffset() const { return 1 + 3 * corners(); } ///< of the first corner's, in floats
  std::size_t texCoordOffset(std::size_t corner, std::size_t set) const {
    return attributesOffset() + corner * cornerFloats() + (normals ? 3 : 0) + 2 * set;
  }
  std::size_t recordFloats() const { return attributesOffset() + corners() * cornerFloats(); }

  /// Appends the record of an element with positions of its own.
  void append(std::vector<float>& records, std::uint32_t tag, const Mesh& mesh, std::size_t element) const;

  /// The elements of records as a mesh in which each corner has a position and a wedge of its own.
  Mesh meshOf(std::span<const float> records) const;
};

inline std::uint32_t tagOf(const float* record) {
  return std::bit_cast<std::uint32_t>(record[0]);
}
inline Vec3f positionOf(const float* record, std::size_t corner) {
  const float* at = record + 1 + 3 * corner;
  return {at[0], at[1], at[2]};
}

} // namespace imgeo
