#pragma once
// Normals that are stored as two numbers, and the error bound of every stored normal:
// docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

namespace imgeo {

/// Whether a normal is stored as two numbers: octahedral x and y, or spherical phi and theta. Otherwise it is stored as
/// the three components of the vector.
bool isPair(NormalEncoding encoding);

/// Converts a unit vector to two numbers of `bits` bits each, and back. `isPair(encoding)` holds.
Vec2<std::uint32_t> storeNormal(Vec3f unit, NormalEncoding encoding, std::uint32_t bits);
Vec3f loadNormal(Vec2<std::uint32_t> stored, NormalEncoding encoding, std::uint32_t bits);

/// The maximum angle, in radians, between a unit normal and its stored value. 0 for palettes and compact, whose
/// encoders state it: EncodedPatch::normalError.
double normalErrorBound(const GeometryDescription& geometry);

} // namespace imgeo
