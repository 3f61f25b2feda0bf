#pragma once
// Whether a mesh without normals is shaded better with creases.

#include "scene/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace imgeo {

/// The positions of a triangle, from one of its corners on.
using CornerTriangle = std::array<Vec3f, 3>;

/// The triangles at some of the vertices of a mesh, which may be a piece of one of `triangles` triangles: which
/// vertices these are depends on their positions and that number alone, so that all pieces together give what the mesh
/// gives.
std::vector<CornerTriangle> sampledCorners(const Mesh& mesh, std::uint64_t triangles);

/// Appends those of the next piece. What isManMade() says is the same as of the whole mesh.
void appendSampledCorners(std::vector<CornerTriangle>& corners, const std::vector<CornerTriangle>& next);

/// Whether a triangle mesh seems to be a man-made object, as furniture and machine parts are, instead of a scan or a
/// smooth model. Of the edges at its sampled vertices, as many are sharper than manMadeCreaseDegrees as there are of
/// curved surfaces: less sharp, but of more than 19 degrees. And at least a quarter are between triangles of one plane,
/// or hardly any are neither that nor sharp, as of an octahedron. Scans have fewer edges the sharper these are.
bool isManMade(std::vector<CornerTriangle> corners);

/// The same of a whole mesh.
bool isManMade(const Mesh& mesh);

} // namespace imgeo
