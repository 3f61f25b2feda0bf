#pragma once
// What a document says of one geometry: its lattice, its patches, and where
// each patch's data lies. Writers of containers produce it, documents carry it,
// readers of containers consume it. docs/formats/nodes.md is its text form.

#include "prepare/lattice.h"
#include "prepare/primitives.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

enum class Container : std::uint8_t { sig, bg };

/// What a file holds; also its row in `info`.
enum class Role : std::uint8_t { index, coord, normal, texCoord, color };

/// "index", "coord", ...: the names the documents use.
const char* nameOf(Role role);

/// "POINTS", "TRIANGLESTRIP", ...: as X3DOM's `primType` has them.
const char* nameOf(Primitive primitive);

/// How unit normals are stored: as three components, as two numbers
/// (containers/normals.h), or as RGB out of an image's palette.
enum class NormalEncoding : std::uint8_t { rgb, octahedral, spherical, palette };
const char* nameOf(NormalEncoding encoding);

/// The element type of a BG attribute, as X3DOM names them ("Uint16" ...).
enum class ElementType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32 };
const char* nameOf(ElementType type);
std::uint32_t byteSizeOf(ElementType type);

/// Where an attribute's data begins. Images: `first` is the first texel. Typed
/// arrays: `first` is a byte offset and `stride` the bytes from one element to
/// the next (0: tightly packed).
struct Reference {
  std::string url; ///< relative to the document
  std::uint32_t first = 0;
  std::uint32_t stride = 0;
  friend bool operator==(const Reference&, const Reference&) = default;
};

struct PatchDescription {
  Box3d box;                     ///< tight, for culling and priority
  std::uint32_t vertexCount = 0; ///< records in coord, normal, ...; 0: the largest index + 1
  std::vector<Draw> draws;
  Vec2<std::uint32_t> implicitMeshSize{256, 256}; ///< SIG: columns and rows that indices fill
  std::optional<Reference> index;                 ///< absent: records are drawn in order
  std::vector<Reference> coord;                   ///< SIG: byte planes, most significant first. BG: one
  std::optional<Reference> normal, texCoord, color;
  friend bool operator==(const PatchDescription&, const PatchDescription&) = default;
};

/// The fields of one ImageGeometry or BinaryGeometry node.
struct GeometryDescription {
  Container container = Container::sig;
  Lattice lattice;                             ///< `position` and `size` follow from it: see decodeFields
  Box3d box;                                   ///< tight box of all patches
  Vec2f texCoordMin{0, 0}, texCoordSize{1, 1}; ///< texture coordinates are stored relative to this box
  std::uint32_t colorComponents = 3;
  ElementType indexType = ElementType::uint16, coordType = ElementType::uint16,
              normalType = ElementType::int8, texCoordType = ElementType::uint16,
              colorType = ElementType::uint8; ///< BG only, but for indexType: SIG has uint16 and uint32
  NormalEncoding normalEncoding = NormalEncoding::rgb;
  std::vector<PatchDescription> patches;
  friend bool operator==(const GeometryDescription&, const GeometryDescription&) = default;
};

/// Where X3DOM has spherical normals of 16-bit coordinates: in the fourth element of their records.
Reference normalInCoords(const Reference& coord);

/// Whether the normals of every patch are X3DOM's normalAsSphericalCoordinates.
bool hasNormalsInCoords(const GeometryDescription& geometry);

bool isUnsigned(ElementType type);
/// The integer that stands for 1: 127, 255, 32767, 65535 ...; 1 for Float32.
double maximumOf(ElementType type);

} // namespace imgeo
