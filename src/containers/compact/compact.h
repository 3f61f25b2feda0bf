#pragma once
// SIG compact: a patch in one image, predicted and packed, decoded from front to
// back. Byte by byte: docs/formats/compact.md.

#include "containers/container.h"

namespace imgeo {

/// Encodes a patch of at most compact::maxPatchCount vertices and elements by the
/// node's fields. Of points, each wedge is one. Throws Error{limit} for a patch
/// whose bytes fill more than an image.
EncodedPatch encodeCompact(const Patch& patch, const GeometryDescription& geometry,
                           const EncodeOptions& options);

/// Decodes a patch. Safe for untrusted bytes; see decodePatch.
IndexedPatch decodeCompact(const PatchDescription& patch, const GeometryDescription& geometry,
                           const FetchFile& fetch);

/// What the header of a patch's file says of its attributes. Safe for untrusted bytes.
StoredPrecision precisionOfCompact(const PatchDescription& patch, const FetchFile& fetch);

} // namespace imgeo
