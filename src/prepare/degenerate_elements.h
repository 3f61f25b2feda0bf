#pragma once
// Elements that quantisation makes degenerate.

#include "scene/mesh.h"

#include <span>

namespace imgeo {

/// Counts the triangles that have an area, and the lines that have a length, in the source but none on the lattice:
/// quantisation moves their corners onto one point or one line. `points` are the mesh's positions on a lattice of
/// `bits` bits.
std::size_t countCollapsedElements(const Mesh& mesh, std::span<const Vec3u> points, std::uint32_t bits);

} // namespace imgeo
