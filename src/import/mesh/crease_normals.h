#pragma once
// Normals by crease angle for triangle meshes without normals.

#include "scene/mesh.h"

namespace imgeo {

/// Returns the mesh, which must have no normals and no further attributes, with normals: smooth across edges of at most
/// `creaseAngle` radians, sharp across others. Merges equal positions, since files may repeat the vertices of an edge.
Mesh withCreaseNormals(const Mesh& mesh, double creaseAngle);

} // namespace imgeo
