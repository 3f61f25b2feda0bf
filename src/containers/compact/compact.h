#pragma once
// SIG compact: patches whose values are predicted and entropy-coded, as the pixels of an image. Specification:
// docs/formats/compact.md.

#include "containers/compact/compact_patch.h"
#include "containers/encodings.h"
#include "containers/lru_cache.h"

#include <span>

namespace imgeo {

/// The row of compact in the registry.
extern const EncodingRow compactEncoding;

/// See EncodingRow::resolveOptions.
void resolveCompactOptions(ConvertOptions& options);

/// How patches and base meshes share files.
extern const FileSharing compactSharing;

/// Quantises a patch by the fields of its node. Every wedge of a point cloud becomes a point.
compact::CompactPatch quantisePatch(Patch patch, const GeometryDescription& geometry, const EncodeOptions& options);

/// The description of a quantised patch, without its reference.
PatchDescription describe(const compact::CompactPatch& patch, const GeometryDescription& geometry);

/// Encodes patches into one file, in this order: at most compact::maxFilePatches patches of compact::maxFileTypes
/// types, which together have at most compact::maxCount vertices, wedges and elements. Throws Error{limit} for
/// more bytes than an image holds.
EncodedSharedFile encodeCompact(std::span<const compact::CompactPatch> patches, int effort);

/// Reads patches and base meshes of compact. A file is decoded once if its patches are requested one after the other.
class CompactReader final : public PatchReader {
public:
  explicit CompactReader(FetchFile fetch) : fetch_(std::move(fetch)) {}

  /// Throws Error{malformed} also for a patch that the description does not fit.
  IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry) override;

  BaseMesh decodeBase(const GeometryDescription& geometry) override;

  /// The precision that the file of the first patch states.
  StoredPrecision precisionOf(const GeometryDescription& geometry) override;

private:
  using Patches = std::vector<compact::CompactPatch>;
  using AttributeTypes = std::vector<compact::AttributeType>;

  std::shared_ptr<const Patches> patchesOf(const std::string& url);

  FetchFile fetch_;
  LruCache<Patches> patches_;
  LruCache<std::vector<AttributeTypes>> types_; ///< per patch
};

} // namespace imgeo
