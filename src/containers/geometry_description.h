#pragma once
// What a document says of one geometry: its lattice, its patches, and where
// each patch's data lies. Writers of containers produce it, documents carry it,
// readers of containers consume it. docs/formats/nodes.md is its text form.

#include "containers/reference.h"
#include "imgeo/encoding.h"
#include "prepare/lattice.h"
#include "prepare/primitives.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

/// What a file holds; also its row in `info`.
enum class Role : std::uint8_t { index, coord, normal, texCoord, color, attribute, patch, base };

/// "index", "coord", ...: the names the documents use.
const char* nameOf(Role role);

/// "POINTS", "TRIANGLESTRIP", ...: as X3DOM's `primType` has them.
const char* nameOf(Primitive primitive);

std::uint32_t byteSizeOf(ElementType type);

struct PatchDescription {
  Box3d box;                     ///< tight, for culling and priority
  std::uint32_t vertexCount = 0; ///< records in coord, normal, ...; 0: the largest index + 1
  std::vector<Draw> draws;
  Vec2<std::uint32_t> implicitMeshSize{256, 256}; ///< SIG: columns and rows that indices fill
  std::optional<Reference> index;                 ///< absent: records are drawn in order
  std::vector<Reference> coord;                   ///< SIG: byte planes, most significant first. BG: one
  std::optional<Reference> normal, texCoord, color;
  std::vector<std::vector<Reference>> attributes; ///< each of the geometry's: its byte planes (SIG) or one (BG)
  std::optional<Reference> data;                  ///< compact: all of it
  friend bool operator==(const PatchDescription&, const PatchDescription&) = default;
};

/// Calls visit(role, reference) for everything that a patch refers to.
template <typename Patch, typename Visit> void visitReferences(Patch& patch, Visit visit) {
  if (patch.index)
    visit(Role::index, *patch.index);
  for (auto& plane : patch.coord)
    visit(Role::coord, plane);
  if (patch.normal)
    visit(Role::normal, *patch.normal);
  if (patch.texCoord)
    visit(Role::texCoord, *patch.texCoord);
  if (patch.color)
    visit(Role::color, *patch.color);
  for (auto& planes : patch.attributes)
    for (auto& plane : planes)
      visit(Role::attribute, plane);
  if (patch.data)
    visit(Role::patch, *patch.data);
}

/// A further attribute of vertices: one FloatVertexAttribute.
struct AttributeDescription {
  std::string name;
  std::uint32_t components = 1; ///< 1..4
  std::uint32_t bytes = 2;      ///< SIG: byte planes of each number, 1..3. BG has Float32
  /// By component. SIG: the box over which stored integers 0 .. 256^bytes - 1 are spread. BG: what the
  /// numbers lie in.
  std::vector<double> min, size;
  friend bool operator==(const AttributeDescription&, const AttributeDescription&) = default;
};

/// The fields of one ImageGeometry or BinaryGeometry node.
struct GeometryDescription {
  Encoding encoding = Encoding::classic;
  Lattice lattice;                             ///< `position` and `size` follow from it: see decodeFields
  Box3d box;                                   ///< tight box of all patches
  Vec2f texCoordMin{0, 0}, texCoordSize{1, 1}; ///< texture coordinates are stored relative to this box
  std::uint32_t colorComponents = 3;
  ElementType indexType = ElementType::uint16, coordType = ElementType::uint16, normalType = ElementType::int8,
              texCoordType = ElementType::uint16,
              colorType = ElementType::uint8; ///< BG only, but for indexType: SIG has uint16 and uint32
  NormalEncoding normalEncoding = NormalEncoding::rgb;
  std::vector<AttributeDescription> attributes;
  std::vector<PatchDescription> patches;
  std::optional<Reference> base; ///< compact: what stands in for the patches until they are there
  friend bool operator==(const GeometryDescription&, const GeometryDescription&) = default;
};

/// The reference to normals in the fourth element of 16-bit coordinates, where X3DOM has spherical normals. `coord` has
/// a ByteLocation.
ByteLocation normalInCoords(const ByteLocation& coord);
Reference normalInCoords(const Reference& coord);

/// Whether the normals of every patch are X3DOM's normalAsSphericalCoordinates.
bool hasNormalsInCoords(const GeometryDescription& geometry);

bool isUnsigned(ElementType type);
/// The integer that stands for 1: 127, 255, 32767, 65535 ...; 1 for Float32.
double maximumOf(ElementType type);

} // namespace imgeo
