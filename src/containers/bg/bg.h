#pragma once
// BG: a patch as typed arrays that go to the GPU as they are (Behr et al. 2012,
// section 3: "explicit binary containers"; fields as X3DOM 1.7.2 reads them).
// Byte by byte in docs/formats/bg.md.

#include "containers/container.h"
#include "containers/encodings.h"

namespace imgeo {

/// The row of BG in the registry.
extern const EncodingRow bgEncoding;

/// A file of indices (where there are any) and one for each attribute, or one of
/// records with all of them, of the node's element types. In records every attribute
/// begins at a multiple of four bytes; normals of a byte each lie in the fourth
/// element of 16-bit coordinates.
EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry, Layout layout);

/// Reads what encodeBg writes and every layout of X3DOM's BinaryGeometry: all
/// element types, interleaved records, spherical normals. Safe for untrusted
/// bytes; see decodePatch. Throws Error{unsupported} for signed indices,
/// unsigned components of normals, and pairs of other than 8 or 16 bits.
IndexedPatch decodeBg(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
