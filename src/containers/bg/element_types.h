#pragma once
// Chooses the element types of the attributes of a BinaryGeometry.

#include "containers/encodings.h"

namespace imgeo {

/// Sets the element types of `geometry` for the attributes of `mesh`, and rounds its box to Float32 if coordinates are
/// Float32. Lattice, texture coordinate box and normal encoding are set already. Throws Error{unsupported} for
/// attributes that X3DOM cannot read from records of one type.
void chooseTypes(GeometryDescription& geometry, const PatchedMesh& mesh, const EncodeOptions& options);

} // namespace imgeo
