#pragma once
// What a lattice is too coarse for.

#include "prepare/lattice.h"
#include "scene/mesh.h"

namespace imgeo {

/// Triangles that have an area in the source, and lines that have a length, and none
/// on the lattice: their corners come to lie in one place or in one line.
std::size_t collapsedElements(const Mesh& mesh, const Lattice& lattice);

} // namespace imgeo
