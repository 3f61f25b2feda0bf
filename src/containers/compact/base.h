#pragma once
// The bases of geometries <-> a file: docs/formats/compact.md, "Base".

#include "containers/compact/compact_patch.h"
#include "containers/container.h"
#include "prepare/base_mesh.h"

#include <span>

namespace imgeo {

/// A base as files hold it. What comes back of it has other numbers; positions of one part
/// alone have moved by a small share of an edge. Texture coordinates have at most these bits
/// and no more than such shares need; of further attributes 256 values differ.
compact::CompactPatch baseInIntegers(const BaseMesh& base, const GeometryDescription& geometry,
                                     std::uint32_t texCoordBits, std::uint32_t colorBits);

/// The file of such bases, whose numbers in it are their places here; as many as
/// encodeCompact takes. Deterministic. Throws Error{limit} for more than an image holds.
EncodedFile baseFile(std::span<const compact::CompactPatch> bases);

/// What a decoded base is, without its attributes.
BaseMesh meshOfBase(const compact::CompactPatch& base);

} // namespace imgeo
