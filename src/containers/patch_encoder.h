#pragma once
// Encodes patches into geometry files, in every encoding.

#include "base/bytes.h"
#include "containers/geometry_description.h"
#include "imgeo/convert.h"
#include "prepare/patches.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

/// Options of convert that an encoding needs, with every default filled in.
struct EncodeOptions {
  Encoding encoding = Encoding::classic;
  /// Bits of a stored component. Classic: 8 or 16. Compact: 4 .. 16. BG: 8, 16 or 32 (Float32); for octahedral and
  /// spherical normals 16, or 8 beside coordinates of 9 .. 16 bits.
  std::uint32_t normalBits = 8;
  int effort = 5; ///< 0 fastest .. 9 smallest
  Target target = Target::web;
  NormalEncoding normals = NormalEncoding::rgb;   ///< palette: classic only. Compact: octahedral or derived
  std::optional<ElementType> coordType{};         ///< BG; nothing: the smallest unsigned type
  Layout layout = Layout::separate;               ///< BG
  std::uint32_t attributeBits = 16;               ///< SIG: 8, 16 or 24; BG has Float32
  std::uint32_t texCoordBits = 16, colorBits = 8; ///< as in Capabilities
  Primitives primitives = Primitives::triangles;  ///< point clouds are always points
  bool indexed = true;                            ///< false: vertices are repeated wherever they are drawn
  ImageFormat images = ImageFormat::png;          ///< classic
};

/// A file of a site, before it has a name.
struct EncodedFile {
  Role role = Role::coord;
  std::string extension; ///< ".png", ".bin"
  Bytes bytes;
};

/// Index of a file in EncodedPatch::files.
enum class FileIndex : std::uint32_t {};

/// A reference to a file that has no url yet. describeWithUrls turns it into a Reference.
struct FileReference {
  Role role = Role::coord;
  FileIndex file{};
  FileLocation location;
  std::size_t attributeIndex = 0; ///< index in GeometryDescription::attributes; Role::attribute only
};

/// The files of one patch.
struct EncodedPatch {
  PatchDescription description; ///< without references
  std::vector<EncodedFile> files{};
  std::vector<FileReference> references{}; ///< byte planes of an attribute: most significant first
  ElementCounts elements{};                ///< drawn elements; triangles that only join strips are not counted
  /// Largest angle between a normal and its stored value, in radians: measured for palettes and derived normals, a
  /// bound for octahedral normals in compact. 0: see normalErrorBound.
  double normalError = 0;
};

/// The geometry node's own fields for a mesh, before its patches are encoded. Throws Error{unsupported} for texture
/// coordinates that X3DOM cannot hold.
GeometryDescription describe(const PatchedMesh& mesh, const EncodeOptions& options);

/// Encodes a patch by the fields of its node. Deterministic. `patch` is one of the mesh that was described, and has no
/// NaN. Throws Error{limit} for a patch that draws more than an image holds.
EncodedPatch encodePatch(Patch patch, const GeometryDescription& geometry, const EncodeOptions& options);

/// Encodes vertices in a given order, for encodings that have EncodingRow::encodeIndexed.
EncodedPatch encodePatch(const IndexedPatch& patch, const GeometryDescription& geometry, const EncodeOptions& options);

/// The description of an encoded patch with its references; `urls` are those of its files.
PatchDescription describeWithUrls(const EncodedPatch& encoded, std::span<const std::string> urls);

} // namespace imgeo
