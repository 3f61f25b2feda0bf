#pragma once
// SIG classic: a patch as images that a GPU reads by texel (Behr et al. 2012, "Using images and explicit binary
// container for efficient and incremental delivery of declarative 3D scenes on the web", section 4; fields as X3DOM
// 1.7.2 reads them). Coordinates are byte planes, most significant first, so that the first image alone shows the
// shape. Specification: docs/formats/sig-classic.md.

#include "containers/encodings.h"

namespace imgeo {

/// The row of classic in the registry.
extern const EncodingRow classicEncoding;

/// See EncodingRow::resolveOptions.
void resolveClassicOptions(ConvertOptions& options);

/// Writes one image for the indices if there are any, one for each byte of a coordinate, those of normals, texture
/// coordinates and colours (imageCountOf), and one for each byte of further attributes. For X3DOM, which has one
/// implicit mesh for a page, all images are 256 wide. Throws Error{limit} if the indices, the records without an index,
/// or the normals of two numbers do not fit into an image of guaranteedImageEdge rows and 256 (X3DOM) or
/// guaranteedImageEdge columns.
EncodedPatch encodeClassic(const IndexedPatch& patch, const GeometryDescription& geometry,
                           const EncodeOptions& options);

/// Writes the images of one or several grids of `columns` columns, one grid below the other, without an index. Images
/// are as wide as the grids, and `vertices` has whole rows: at most maxImageEdge. The result has no description: that
/// of a grid, and where in the images it begins, the caller knows.
EncodedPatch encodeGrids(const IndexedPatch& vertices, std::uint32_t columns, const GeometryDescription& geometry,
                         const EncodeOptions& options);

/// Reads the images of encodeClassic and X3DOM's ImageGeometry with record images of any size. Safe for untrusted
/// bytes.
IndexedPatch decodeClassic(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
