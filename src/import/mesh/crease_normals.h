#pragma once
// Normals by crease angle for triangle meshes without normals.

#include "scene/mesh.h"

namespace imgeo {

/// Returns a copy of the mesh with normals: smooth across edges of at most `creaseAngle` radians, sharp across others.
/// The mesh must have triangles, no normals and no further attributes. Merges equal positions, since files may repeat
/// the vertices of an edge.
Mesh withCreaseNormals(const Mesh& mesh, double creaseAngle);

} // namespace imgeo
