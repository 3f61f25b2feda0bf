#pragma once
// Coordinates on the lattice <-> the numbers that containers store, and the
// document's `position` and `size`, over which X3DOM spreads those numbers:
// docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

#include <cstdint>
#include <string>

namespace imgeo {

/// Bytes a coordinate takes at least: 1, 2, 3 or 4 byte planes (SIG), 1, 2 or 4 bytes (BG).
std::uint32_t coordBytes(Encoding encoding, std::uint32_t bits);

/// The unsigned element type of so many bytes, 1, 2 or 4.
ElementType unsignedTypeOf(std::uint32_t bytes);

/// Bits of a lattice by which Float32 coordinates are the source's own numbers: the
/// lattice is then only what our readers put them on.
inline constexpr std::uint32_t sourceBits = 32;

/// Bits of packed coordinates where a node states no positionBits.
inline constexpr std::uint32_t packedPositionBits = 16;

/// Whether BG coordinates of a type can stand for a lattice of so many bits: any up
/// to the type's; of signed types all of them or one less, of which X3DOM makes use;
/// of Float32 at most 24, or sourceBits.
bool holdsLattice(ElementType type, std::uint32_t bits);

/// Integers for lattice coordinates q: (q << shift) + bias. Unsigned ones are shifted
/// left to fill their bytes, so that the first byte always holds the eight most
/// significant bits. Signed ones lie around zero; where they have a bit more than the
/// lattice, within X3DOM's half of their range, and else in all of it.
struct StoredCoords {
  std::uint32_t shift = 0;
  std::int64_t bias = 0;
  double maximum = 1;        ///< the integer that X3DOM has at the far end of `size`
  std::uint32_t largest = 0; ///< q, 2^bits - 1
};

/// `type` is of BG, and no Float32.
StoredCoords storedCoords(Encoding encoding, ElementType type, std::uint32_t bits);

inline std::int64_t storeCoord(std::uint32_t q, const StoredCoords& stored) {
  return (static_cast<std::int64_t>(q) << stored.shift) + stored.bias;
}
/// Throws Error{malformed} with `location` for a stored integer that is no lattice point.
std::uint32_t loadCoord(std::int64_t value, const StoredCoords& stored, const std::string& location);

/// The lattice point nearest to a Float32 position. Throws Error{malformed} with
/// `location` for one that lies outside by more than roundings. The lattice is a cube's.
Vec3u nearestPoint(Vec3f position, const Lattice& lattice, const std::string& location);

/// The node's `position` and `size`.
struct DecodeFields {
  Vec3d position, size;
};
DecodeFields decodeFields(const GeometryDescription& geometry);

/// The lattice of a node read back; inverse of decodeFields but for roundings of the
/// last bits. `size` has no negative edge and not only zeros; `type` holds `bits`. Of
/// Float32 coordinates a cube, of sourceBits one twice as large, so that what others
/// wrote for a box that is a little too small is found in it.
Lattice latticeOf(const DecodeFields& fields, Encoding encoding, ElementType type, std::uint32_t bits);

/// The lattice on which a mesh is encoded: that of its box, moved and stretched by so
/// little of a step (a 1024th) that documents say it in few digits.
Lattice latticeFor(const Box3d& box, ElementType type, std::uint32_t bits);

/// Where our readers find a vertex that was written from the point q of `written`:
/// there, but for what Float32 cannot hold.
Vec3u pointReadBack(Vec3u q, const Lattice& written, const GeometryDescription& geometry);

/// How far, along an axis, a vertex of the source may be from where it is drawn.
double positionErrorBound(const GeometryDescription& geometry);

} // namespace imgeo
