#pragma once
// Quantises the attributes of a patch, and dequantises those of a decoded one.

#include "containers/compact/compact_patch.h"
#include "containers/geometry_description.h"
#include "prepare/patches.h"

namespace imgeo::compact {

/// Bits of the attributes, and the mode of normals.
struct AttributeBits {
  std::uint32_t normal = 8, texCoord = 12, color = 8;
  NormalMode normalMode = NormalMode::area;
};

/// Quantises a patch. Points are in Morton order, each wedge once and with its own position; lines are in the order of
/// trails. Normals become points of the octahedron (octahedronPoint), two coordinates of which are rounded. Texture
/// coordinates are rounded to 2^bits values over the node's box, colours to 2^bits values over 0 .. 255.
CompactPatch quantise(Patch patch, const GeometryDescription& geometry, const AttributeBits& bits);

/// Quantised attributes with one value for each wedge.
Attribute texCoordAttribute(const std::vector<Vec2f>& texCoords, const TexCoordBox& box, std::uint32_t bits);
Attribute colorAttribute(const std::vector<Rgba>& colors, std::uint32_t components, std::uint32_t bits);

/// Values are rounded to 2^bits values over the range of the description; `bits` is 1 .. 8 * description.bytes.
Attribute namedAttribute(const NamedAttribute& named, const AttributeDescription& description, std::uint32_t bits);

/// The draws of a patch: all its elements.
std::vector<Draw> drawsOf(const CompactPatch& patch);

/// The vertices (wedges) and elements of a decoded patch. Normals have unit length. Attributes of kind `other` are
/// those of the geometry, with the same components and bits; each of the others has a role (RoleCounter).
IndexedPatch verticesOf(const CompactPatch& patch, const GeometryDescription& geometry);

} // namespace imgeo::compact
