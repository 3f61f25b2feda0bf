#pragma once
// Normals that are stored as two numbers, and how far any stored normal may be
// off: docs/formats/nodes.md, "Stored values".

#include "containers/geometry_description.h"

namespace imgeo {

/// Whether a normal is two numbers: octahedral x and y, or spherical phi and
/// theta. Otherwise it is the three components of the vector.
bool isPair(NormalEncoding encoding);

/// The two numbers of a unit vector, each of `bits` bits, and back. `encoding` is a pair.
Vec2<std::uint32_t> storeNormal(Vec3f unit, NormalEncoding encoding, std::uint32_t bits);
Vec3f loadNormal(Vec2<std::uint32_t> stored, NormalEncoding encoding, std::uint32_t bits);

/// The largest angle, in radians, between a unit normal and what is stored of it. A
/// palette and compact have no such bound here: there it is what EncodedPatch says, and this is 0.
double normalErrorBound(const GeometryDescription& geometry);

} // namespace imgeo
