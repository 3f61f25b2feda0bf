#pragma once
// A quantised patch. The compact format keeps it exactly, except for the order of elements, corners, vertices and
// wedges, and except for what `residualShift` rounds in a base.

#include "base/vec.h"
#include "prepare/vertex_grid.h"
#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace imgeo::compact {

enum class AttributeKind : std::uint8_t { normal, texCoord, color, other };

/// Finds the vertex attributes that the attributes of a patch are. The n-th texture coordinates of a patch are those of
/// set n.
class RoleCounter {
public:
  /// The role of the next attribute; nothing for further attributes, second normals or colours, and texture coordinates
  /// beyond the last set.
  std::optional<VertexRole> next(AttributeKind kind) {
    const std::size_t before = counts_[static_cast<std::size_t>(kind)]++;
    switch (kind) {
    case AttributeKind::normal:
      return before == 0 ? std::optional(VertexRole::normal) : std::nullopt;
    case AttributeKind::texCoord:
      return before < maxTexCoordSets ? std::optional(texCoordRoles[before]) : std::nullopt;
    case AttributeKind::color:
      return before == 0 ? std::optional(VertexRole::color) : std::nullopt;
    case AttributeKind::other:
      break;
    }
    return std::nullopt;
  }

private:
  std::array<std::size_t, 4> counts_{}; ///< attributes so far, by kind
};

/// How the normal of a wedge is predicted from the normals of its triangles: weighted by area or all alike. With a
/// derived mode the prediction is the normal, and the file stores no normals.
enum class NormalMode : std::uint8_t { area, uniform, derivedArea, derivedUniform };

struct AttributeType {
  AttributeKind kind = AttributeKind::other;
  std::uint8_t components = 1, bits = 8;
  NormalMode mode = NormalMode::area; ///< normals only

  bool isDerived() const { return mode == NormalMode::derivedArea || mode == NormalMode::derivedUniform; }
  bool isUniform() const { return mode == NormalMode::uniform || mode == NormalMode::derivedUniform; }
  friend bool operator==(const AttributeType&, const AttributeType&) = default;
};

/// One value of an attribute; components beyond those of its type are 0.
struct Value {
  std::array<std::int32_t, 4> components{};

  std::int32_t& operator[](std::uint32_t i) { return components[i]; }
  std::int32_t operator[](std::uint32_t i) const { return components[i]; }
  friend bool operator==(const Value&, const Value&) = default;
};

struct Attribute {
  AttributeType type;
  /// Per wedge. Normals are points of the octahedron |x| + |y| + |z| = 2^(bits - 1) - 1; components of other
  /// attributes are 0 .. 2^bits - 1.
  std::vector<Value> values;
  /// Encoders only: the unit normals that `values` round, per wedge. Empty if the values are exact.
  std::vector<Vec3f> sourceNormals{};

  friend bool operator==(const Attribute& a, const Attribute& b) { return a.type == b.type && a.values == b.values; }
};

/// The bits of coordinates that a file can have (docs/formats/compact.md); `convert` writes 8 and more.
/// web/src/stage/packedPositionBits.ts has the same.
inline constexpr std::uint32_t minPositionBits = 1, maxPositionBits = 30;

struct CompactPatch {
  Topology topology = Topology::triangles;
  std::uint32_t positionBits = 16;           ///< minPositionBits .. maxPositionBits
  std::vector<Vec3u> positions;              ///< per vertex, 0 .. 2^positionBits - 1
  std::vector<std::uint32_t> wedgePositions; ///< wedge -> vertex
  std::vector<std::uint32_t> corners;        ///< corner -> wedge, cornersPerElement(topology) corners per element
  std::vector<Attribute> attributes;
  /// Encoders only: see Patch::grid.
  std::optional<VertexGrid> grid{};
  /// Decoders only, triangles only: see Connectivity::fans.
  std::vector<std::uint32_t> fans{};
  /// Base only: the segment of each triangle, below `segmentCount`. Empty in a patch.
  std::vector<std::uint32_t> segments;
  std::uint32_t segmentCount = 0; ///< 0: a patch, not a base
  /// Base only: the residuals of positions that only one segment has are rounded to multiples of 2^residualShift.
  std::uint32_t residualShift = 0;

  std::size_t wedgeCount() const { return wedgePositions.size(); }
  std::size_t elementCount() const { return corners.size() / cornersPerElement(topology); }
};

/// Maximum number of vertices, of wedges and of elements, both of a patch and of all patches of a file together.
inline constexpr std::uint32_t maxCount = 1u << 20;
inline constexpr std::uint32_t maxAttributes = 16;

} // namespace imgeo::compact
