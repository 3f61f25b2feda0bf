#pragma once
// A patch's attributes in integers, and back.

#include "containers/compact/compact_patch.h"
#include "containers/geometry_description.h"
#include "prepare/patches.h"

namespace imgeo::compact {

/// Bits of the attributes, and how normals are told.
struct AttributeBits {
  std::uint32_t normal = 8, texCoord = 12, color = 8;
  NormalMode normalMode = NormalMode::area;
};

/// Points come in Morton order, each wedge once and with a position of its own; lines
/// one behind the other. Normals go to the octahedron's point of octahedronPoint, each coordinate of which
/// is at most half a step off; texture coordinates to 2^bits points over the
/// node's box, colours over 0 .. 255, both to the nearest.
CompactPatch quantise(Patch patch, const GeometryDescription& geometry, const AttributeBits& bits);

/// Attributes, one value a wedge, as `quantise` has them.
Attribute texCoordAttribute(const std::vector<Vec2f>& texCoords, const GeometryDescription& geometry,
                            std::uint32_t bits);
Attribute colorAttribute(const std::vector<Rgba8>& colors, std::uint32_t components, std::uint32_t bits);

/// `bits` are 1 .. 8 * description.bytes; with less than that, over the same box.
Attribute namedAttribute(const NamedAttribute& named, const AttributeDescription& description, std::uint32_t bits);

/// What is drawn of a patch: all its elements.
std::vector<Draw> drawsOf(const CompactPatch& patch);

/// The vertices and elements that a decoded patch stands for: its wedges. Normals
/// are unit length. Attributes of kind
/// `other` are as many, of the same components and bits, as the geometry's further ones.
IndexedPatch verticesOf(const CompactPatch& patch, const GeometryDescription& geometry);

} // namespace imgeo::compact
