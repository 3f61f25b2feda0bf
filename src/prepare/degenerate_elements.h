#pragma once
// What a lattice is too coarse for.

#include "scene/mesh.h"

#include <span>

namespace imgeo {

/// Triangles that have an area in the source, and lines that have a length, and none
/// on the lattice: their corners come to lie in one place or in one line. `points` are
/// the mesh's positions on a lattice of so many bits.
std::size_t countCollapsedElements(const Mesh& mesh, std::span<const Vec3u> points, std::uint32_t bits);

} // namespace imgeo
