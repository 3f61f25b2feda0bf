#pragma once
// Base meshes of geometries <-> a file: docs/formats/compact.md, "Base".

#include "containers/compact/compact_patch.h"
#include "containers/encodings.h"
#include "prepare/base_mesh.h"

#include <span>

namespace imgeo {

/// Quantises a base mesh. Decoding returns its elements in another order, and moves positions that only one segment has
/// by a small fraction of an edge. Texture coordinates get at most `texCoordBits` bits, and fewer if coarser steps are
/// small compared with the edges in the texture; further attributes get enough bits to tell 256 values apart.
compact::CompactPatch quantiseBase(const BaseMesh& base, const GeometryDescription& geometry,
                                   std::uint32_t texCoordBits, std::uint32_t colorBits);

/// Encodes base meshes into one file, in this order; encodeCompact has the limits. Deterministic. Throws Error{limit}
/// for more than an image holds.
EncodedFile baseFile(std::span<const compact::CompactPatch> bases);

/// A decoded base mesh without its attributes.
BaseMesh meshOfBase(const compact::CompactPatch& base);

} // namespace imgeo
