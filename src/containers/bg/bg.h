#pragma once
// BG: a patch as typed arrays that go to the GPU as they are (Behr et al. 2012,
// section 3: "explicit binary containers"; fields as X3DOM 1.7.2 reads them).
// Byte by byte in docs/formats/bg.md.

#include "containers/container.h"

namespace imgeo {

/// One file for each of indices (where there are any), coordinates, normals,
/// texture coordinates and colours, of the node's element types.
EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry);

/// Reads what encodeBg writes and every layout of X3DOM's BinaryGeometry: all
/// element types, interleaved records, spherical normals. Safe for untrusted
/// bytes; see decodePatch. Throws Error{unsupported} for signed indices,
/// unsigned components of normals, and pairs of other than 8 or 16 bits.
IndexedPatch decodeBg(const PatchDescription& patch, const GeometryDescription& geometry,
                      const FetchFile& fetch);

} // namespace imgeo
