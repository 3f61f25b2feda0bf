#pragma once
// Lattice coordinates <-> stored numbers, and the document's `position` and `size`, over which X3DOM spreads stored
// numbers: docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

#include <cstdint>
#include <optional>
#include <string>

namespace imgeo {

/// The smallest number of bytes of a coordinate: 1, 2, 3 or 4 (SIG), 1, 2 or 4 (bg).
std::uint32_t coordBytes(Encoding encoding, std::uint32_t bits);

/// The unsigned element type of 1, 2 or 4 bytes.
ElementType unsignedTypeOf(std::uint32_t bytes);

/// A lattice of 32 bits marks Float32 coordinates as the source's own numbers. Our readers round them to that lattice.
inline constexpr std::uint32_t sourceBits = 32;

/// The bits of packed coordinates if a node states no positionBits; compact/compact_patch.h has the range.
inline constexpr std::uint32_t packedPositionBits = 16;

/// Whether a type can store the coordinates of a lattice of `bits` bits, at least 8: integer types store up to their
/// own bits, Float32 up to 24, or sourceBits.
bool holdsLattice(ElementType type, std::uint32_t bits);

/// Stored integers of lattice coordinates q: (q << shift) + bias. Unsigned integers are shifted left to fill their
/// bytes, so that the first byte always holds the eight most significant bits. Signed integers lie around zero: within
/// the half of their range that X3DOM uses if they have more bits than the lattice, otherwise in the whole range.
struct StoredCoords {
  std::uint32_t shift = 0;
  std::int64_t bias = 0;
  double maximum = 1;        ///< the integer that X3DOM puts at the far end of `size`
  std::uint32_t largest = 0; ///< the largest q, 2^bits - 1
};

/// `type` is an integer type; encodings without element types ignore it.
StoredCoords storedCoords(Encoding encoding, ElementType type, std::uint32_t bits);

inline std::int64_t storeCoord(std::uint32_t q, const StoredCoords& stored) {
  return (static_cast<std::int64_t>(q) << stored.shift) + stored.bias;
}
/// Throws Error{malformed} with `location` for a stored integer that is no lattice point.
std::uint32_t loadCoord(std::int64_t value, const StoredCoords& stored, const std::string& location);

/// Whether a Float32 position lies in the cube of a lattice, but for rounding.
bool isInside(Vec3f position, const Lattice& lattice);

/// The lattice point nearest to a Float32 position. Throws Error{malformed} with `location` for a position that lies
/// outside by more than rounding. The lattice covers a cube.
Vec3u nearestPoint(Vec3f position, const Lattice& lattice, const std::string& location);

/// The `position` and `size` fields of a node.
struct DecodeFields {
  Vec3d position, size;
};
DecodeFields decodeFields(const GeometryDescription& geometry);

/// The fields of a compact geometry that states only its box: the cube over the box's longest edge, from its minimum.
/// Empty for a box without extent. web/src/document/geometry.ts does the same.
std::optional<DecodeFields> quantizationCube(const Box3d& box);

/// The lattice of a node; inverse of decodeFields except for rounding of the last bits. No edge of `size` is negative,
/// one at least is positive; `type` can store `bits`. The lattice of Float32 coordinates covers a cube over the longest
/// edge; for sourceBits the cube is twice as large, so that it contains vertices that other programs wrote slightly
/// outside of the box.
Lattice latticeOf(const DecodeFields& fields, Encoding encoding, ElementType type, std::uint32_t bits);

/// The lattice on which a mesh is encoded: that of its box, moved and stretched by at most 1/1024 of a step, so that
/// documents need few digits.
Lattice latticeFor(const Box3d& box, ElementType type, std::uint32_t bits);

/// The lattice point that our readers decode from the written point q: q itself, or for Float32 a point nearby.
Vec3u pointReadBack(Vec3u q, const Lattice& written, const GeometryDescription& geometry);

/// The maximum error of a vertex along an axis.
double positionErrorBound(const GeometryDescription& geometry);

} // namespace imgeo
