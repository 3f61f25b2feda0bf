#pragma once
// BG: a patch as typed arrays that go to the GPU as they are (Behr et al. 2012, section 3: "explicit binary
// containers"; fields as X3DOM 1.7.2 reads them).
// Specification: docs/formats/bg.md.

#include "containers/encodings.h"

namespace imgeo {

/// The row of bg in the registry.
extern const EncodingRow bgEncoding;

/// See EncodingRow::resolveOptions.
void resolveBgOptions(ConvertOptions& options);

/// Writes a file of indices if there are any, and either a file for each attribute or one file of records with all
/// attributes, in the element types of the node. In records every attribute begins at a multiple of four bytes.
/// Normals of two 8-bit numbers lie in the fourth element of 16-bit coordinates.
EncodedPatch encodeBg(const IndexedPatch& patch, const GeometryDescription& geometry, Layout layout);

/// Reads the files of encodeBg and every layout of X3DOM's BinaryGeometry: all element types, interleaved records and
/// spherical normals. Safe for untrusted bytes. Throws Error{unsupported} for signed indices, unsigned components of
/// normals, and normals of two numbers that are not unsigned integers of 8 or 16 bits.
IndexedPatch decodeBg(const PatchDescription& patch, const GeometryDescription& geometry, const FetchFile& fetch);

/// The lattice to decode a geometry with: see PatchReader::latticeOf(). Safe for untrusted bytes. Throws Error as
/// decodeBg().
Lattice findBgLattice(const GeometryDescription& geometry, const FetchFile& fetch);

} // namespace imgeo
