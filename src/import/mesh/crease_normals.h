#pragma once
// Normals by crease angle for triangle meshes without normals.

#include "scene/mesh.h"

namespace imgeo {

/// Returns a copy of the mesh with normals: smooth across edges of at most `creaseAngle` radians, sharp across others.
/// The mesh must have triangles, no normals and no further attributes. Merges equal positions, since files may repeat
/// the vertices of an edge.
Mesh withCreaseNormals(const Mesh& mesh, double creaseAngle);

/// Gives each corner of a triangle a wedge of its own with the normal of the triangle (+z where that has no area).
void makeFlat(Mesh& mesh);

} // namespace imgeo
