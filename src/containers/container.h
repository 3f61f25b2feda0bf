#pragma once
// One patch <-> the files that hold it. Each container has the same functions;
// these pick by Encoding.

#include "base/bytes.h"
#include "containers/geometry_description.h"
#include "prepare/base_mesh.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace imgeo {

struct EncodeOptions {
  Encoding encoding = Encoding::classic;
  /// Bits of a stored component. SIG: 8. Compact: 4 .. 16. BG: 8, 16 or 32 (Float32); octahedral 8 or
  /// 16, spherical 8, and those of 8 only beside coordinates of 9 .. 16 bits.
  std::uint32_t normalBits = 8;
  int effort = 5; ///< 0 fastest .. 9 smallest
  Target target = Target::web;
  NormalEncoding normals = NormalEncoding::rgb;   ///< palette: SIG alone. Compact: octahedral or derived
  std::optional<ElementType> coordType{};         ///< BG; nothing: the smallest unsigned type
  Layout layout = Layout::separate;               ///< BG
  std::uint32_t attributeBits = 16;               ///< SIG: 8, 16 or 24; BG has Float32
  std::uint32_t texCoordBits = 16, colorBits = 8; ///< only compact has others
};

/// A file as it will lie in the site, unnamed yet.
struct EncodedFile {
  Role role = Role::coord;
  std::string extension; ///< ".png", ".bin"
  Bytes bytes;
};

/// Index of a file in EncodedPatch::files.
enum class FileIndex : std::uint32_t {};

/// What describeWithUrls makes a Reference of, once the file has a url.
struct FileReference {
  Role role = Role::coord;
  FileIndex file{};
  FileLocation location;
  std::size_t attributeIndex = 0; ///< index in GeometryDescription::attributes; Role::attribute only
};

/// The files of one patch.
struct EncodedPatch {
  PatchDescription description; ///< without references
  std::vector<EncodedFile> files;
  std::vector<FileReference> references; ///< in the order in which byte planes follow one another
  /// Largest angle between a normal and what is stored of it, in radians: measured for
  /// palettes and derived normals, a bound in compact. 0: see normalErrorBound.
  double normalError = 0;
};

/// The geometry node's own fields for a mesh about to be encoded (no patches
/// yet). Throws Error{unsupported} for texture coordinates that X3DOM cannot hold.
GeometryDescription describe(const PatchedMesh& mesh, const EncodeOptions& options);

/// Encodes a patch by the node's fields, of SIG classic and BG. Deterministic. `patch` is one of
/// the mesh that was described, and has no NaN. Compact: see encodeCompact. Throws Error{limit} for
/// a patch that draws more than an image holds.
EncodedPatch encodePatch(const IndexedPatch& patch, const GeometryDescription& geometry, const EncodeOptions& options);

/// The description of an encoded patch with its references; `urls` are those of its files.
PatchDescription describeWithUrls(const EncodedPatch& encoded, std::span<const std::string> urls);

/// Gives the bytes of a url; throws Error{io} where there are none.
using FetchFile = std::function<Bytes(const std::string& url)>;

/// Bits of a component of each attribute; 0 where there is none.
struct StoredPrecision {
  std::uint32_t normalBits = 0, texCoordBits = 0, colorBits = 0;
  NormalEncoding normalEncoding = NormalEncoding::rgb;
};

class CompactFiles;

/// Reads the containers of one site. A file that patches of compact share is decoded once,
/// for patches that are asked for one after the other. Safe to call from any thread.
class ContainerReader {
public:
  explicit ContainerReader(FetchFile fetch);
  ~ContainerReader();

  /// Decodes a patch. Safe for untrusted bytes: sizes and indices are checked
  /// against the description, and limits (containers/limits.h) bound every
  /// allocation. Throws Error naming the url. Normals come back unit length.
  IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry) const;

  /// Decodes a geometry's base, which it has. The same otherwise.
  BaseMesh decodeBase(const GeometryDescription& geometry) const;

  /// What is stored of a geometry: its node says so, or in compact the file of its first
  /// patch. Safe for untrusted bytes.
  StoredPrecision precisionOf(const GeometryDescription& geometry) const;

private:
  FetchFile fetch_;
  std::unique_ptr<CompactFiles> compact_;
};

/// The same for one patch alone.
IndexedPatch decodePatch(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

/// Decodes an encoded patch from its files in memory.
IndexedPatch decodePatch(const EncodedPatch& encoded, const GeometryDescription& geometry);

} // namespace imgeo
