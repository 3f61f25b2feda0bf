#pragma once
// Which element types the attributes of a BG node have.

#include "containers/container.h"

namespace imgeo {

/// Sets the types of `geometry` (whose lattice, texture coordinates and encoding of
/// normals are set) for the attributes that `mesh` has, and its box to what Float32
/// leaves of it. Throws Error{unsupported} for attributes that X3DOM cannot read
/// from records of one type.
void chooseTypes(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options);

} // namespace imgeo
