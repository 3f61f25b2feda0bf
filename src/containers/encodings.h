#pragma once
// The registry of encodings: what documents, reports and checks of options need to know of each one.

#include "containers/geometry_description.h"
#include "containers/patch_reader.h"
#include "containers/shared_file.h"
#include "imgeo/encoding.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace imgeo {

/// How the values of a patch lie in files.
enum class PatchStorage : std::uint8_t {
  packed,     ///< all values in one range of bytes that only the encoding's reader takes apart
  bytePlanes, ///< an image for each byte of a value; every image has a texel for each vertex
  arrays,     ///< arrays of an ElementType for each attribute, on their own or interleaved
};

/// The X3D node that holds a geometry: docs/formats/nodes.md.
struct GeometryNode {
  const char* name = "";         ///< "ImageGeometry", "BinaryGeometry"
  const char* profile = "";      ///< value of the node's `profile` field; empty: the node has no such field
  bool isDefaultProfile = false; ///< a node of this name without `profile` has this encoding
};

/// Bits of a stored component that an encoding can be asked for.
struct BitRange {
  std::uint32_t min = 0, max = 0, defaultBits = 0;
  std::uint32_t step = 1; ///< bits are a multiple of it

  constexpr bool holds(std::uint32_t bits) const { return bits >= min && bits <= max && bits % step == 0; }
};

/// What an encoding can hold, and what convert can be asked for.
struct Capabilities {
  std::uint32_t maxPositionBits = 32;
  std::uint32_t maxPatchVertices = 0; ///< vertices (wedges) of a patch
  std::size_t maxNamedAttributes = std::numeric_limits<std::size_t>::max();
  BitRange texCoordBits, colorBits;
  std::span<const NormalEncoding> normals; ///< ways to store normals
  bool strips = false;                     ///< triangle strips and line strips
  bool unindexed = false;                  ///< vertices that are repeated wherever they are drawn
  bool elementTypes = false;               ///< --coord-type and --layout choose elements and their order
  bool attributeBits = false;              ///< --attribute-bits chooses the bits of further attributes
  bool maxError = false;                   ///< --max-error chooses the position bits of each mesh
  bool webp = false;                       ///< --images webp chooses the file format of images
  bool base = false;                       ///< a base mesh stands in for patches that have not arrived
  bool levels = false;                     ///< large meshes can have levels of detail
};

/// One encoding.
struct EncodingRow {
  Encoding encoding = Encoding::classic;
  const char* name = "";      ///< see nameOf(Encoding)
  const char* container = ""; ///< value of --container, and of `container` in --json and imgeo.json
  const char* profile = "";   ///< value of --profile, and of `profile` in imgeo.json and `convert --json`
  const char* fileKind = "";  ///< for messages: "PNG images", "typed arrays"
  GeometryNode node;
  PatchStorage storage = PatchStorage::bytePlanes;
  FileLocation location;               ///< the beginning of a file, in the unit of this encoding's references
  bool hasMeasuredNormalError = false; ///< the writer measures how far normals are off; no formula bounds it
  const char* x3domVersion = nullptr;  ///< newest release of X3DOM that reads it; nullptr: none does
  bool isAutomatic = false;            ///< convert may choose it where nothing names an encoding
  Capabilities capabilities;

  /// Fills in the defaults that depend on the encoding. Throws Error{usage}, which names the option, for options that
  /// the encoding cannot hold. Callers check what `capabilities` states.
  void (*resolveOptions)(ConvertOptions& options);
  /// Sets the fields of a node that only this encoding has, or whose values differ from those of describe(). Throws
  /// Error{unsupported} for attributes that the target cannot read.
  void (*describe)(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options);
  /// Writes vertices in a given order; nullptr: the encoding orders vertices itself, and writes by `sharing`.
  EncodedPatch (*encodeIndexed)(const IndexedPatch& patch, const GeometryDescription& geometry,
                                const EncodeOptions& options) = nullptr;
  const FileSharing* sharing = nullptr; ///< nullptr: every patch has its own files
  std::unique_ptr<PatchReader> (*makeReader)(const FetchFile& fetch);
};

/// The row of each encoding, in the order of the enumeration. Where convert chooses, it takes the first automatic
/// row that holds what is asked for.
std::span<const EncodingRow* const> allEncodings();

const EncodingRow& rowOf(Encoding encoding);
inline const EncodingRow& rowOf(const GeometryDescription& geometry) {
  return rowOf(geometry.encoding);
}

/// Whether the values of an encoding are elements of a type, and not bytes of images.
inline bool hasElementTypes(Encoding encoding) {
  return rowOf(encoding).storage == PatchStorage::arrays;
}

/// The row of these values of --container and --profile; nullptr where there is none.
const EncodingRow* findEncoding(std::string_view container, std::string_view profile);

} // namespace imgeo
