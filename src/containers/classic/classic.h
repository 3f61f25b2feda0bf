#pragma once
// SIG classic: a patch as images that a GPU reads by texel (Behr et al. 2012,
// "Using images and explicit binary container for efficient and incremental
// delivery of declarative 3D scenes on the web", section 4; fields as X3DOM
// 1.7.2 reads them). Coordinates are byte planes, most significant first, so
// that the first image alone shows the shape. Byte by byte in
// docs/formats/sig-classic.md.

#include "containers/container.h"
#include "containers/encodings.h"

namespace imgeo {

/// The row of SIG classic in the registry.
extern const EncodingRow classicEncoding;

/// One image for the indices (where there are any), one for each byte of a
/// coordinate, one each for normals, texture coordinates and colours.
/// For X3DOM, which has one implicit mesh a page, all images are 256 wide. Throws
/// Error{limit} for more indices, or records without an index, than an image of
/// that width or of guaranteedImageEdge, and guaranteedImageEdge high, holds.
EncodedPatch encodeClassic(const IndexedPatch& patch, const GeometryDescription& geometry, int effort, Target target);

/// Reads what encodeClassic writes and X3DOM's ImageGeometry with record images of
/// any size. Safe for untrusted bytes; see decodePatch.
IndexedPatch decodeClassic(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
