#pragma once
// SIG compact: patches in images, predicted and packed, decoded from front to
// back. Byte by byte: docs/formats/compact.md.

#include "containers/compact/compact_patch.h"
#include "containers/container.h"
#include "containers/encodings.h"
#include "containers/recent.h"

#include <span>

namespace imgeo {

/// The row of SIG compact in the registry.
extern const EncodingRow compactEncoding;

/// A patch in integers, by the node's fields. Of points, each wedge is one.
compact::CompactPatch quantisePatch(Patch patch, const GeometryDescription& geometry, const EncodeOptions& options);

/// What documents say of such a patch, but for where its data lies.
PatchDescription describe(const compact::CompactPatch& patch, const GeometryDescription& geometry);

struct EncodedCompact {
  EncodedFile file;
  std::vector<double> normalErrors; ///< per patch; see EncodedPatch
};

/// Encodes the patches of one file, whose numbers in it are their places here. Together
/// they have at most compact::maxPatchCount vertices, wedges and elements; they are
/// compact::maxFilePatches and of compact::maxFileTypes types at most. Throws
/// Error{limit} for bytes that fill more than an image.
EncodedCompact encodeCompact(std::span<const compact::CompactPatch> patches, int effort);

/// The files of compact that patches refer to, each read once for patches that are asked
/// for one after the other. Safe to call from any thread, and for untrusted bytes.
/// Throws Error naming the url.
class CompactFiles {
public:
  explicit CompactFiles(FetchFile fetch) : fetch_(std::move(fetch)) {}

  /// The patch, which is what the document says.
  IndexedPatch decode(const PatchDescription& patch, const GeometryDescription& geometry);

  /// The geometry's base, which it has.
  BaseMesh decodeBase(const GeometryDescription& geometry);

  /// What its file says of its attributes.
  StoredPrecision precisionOf(const PatchDescription& patch);

private:
  using Patches = std::vector<compact::CompactPatch>;
  using AttributeTypes = std::vector<compact::AttributeType>;

  std::shared_ptr<const Patches> patchesOf(const std::string& url);

  FetchFile fetch_;
  Recent<Patches> patches_;
  Recent<std::vector<AttributeTypes>> types_; ///< per patch
};

} // namespace imgeo
