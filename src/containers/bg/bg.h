#pragma once
// BG: a patch as typed arrays that go to the GPU as they are (Behr et al. 2012,
// section 3: "explicit binary containers"; fields as X3DOM 1.7.2 reads them).
// Byte by byte in docs/formats/bg.md.

#include "containers/container.h"

namespace imgeo {

/// One file for each of indices (where there are any), coordinates, normals,
/// texture coordinates and colours, of the node's element types.
EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry);

/// Safe for untrusted bytes; see decodePatch. Throws Error{unsupported} for
/// element types that hold no lattice coordinates (Float32, signed) and for
/// signed indices.
IndexedPatch decodeBg(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
