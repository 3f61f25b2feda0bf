#pragma once
// Surfaces that are shaded by the slope of their triangles, as X3DOM draws a BinaryGeometry without normalPerVertex.

#include "prepare/lattice.h"
#include "prepare/primitives.h"
#include "scene/mesh.h"

namespace imgeo {

/// Gives each corner of a triangle a wedge of its own, with the normal of the triangle: +z where it has no area. The
/// mesh consists of triangles.
void makeFlat(Mesh& mesh);

/// The same for a patch. Triangles with two corners at one vertex are left out.
void makeFlat(IndexedPatch& patch, const Lattice& lattice);

} // namespace imgeo
