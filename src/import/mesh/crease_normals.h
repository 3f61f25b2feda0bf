#pragma once
// Normals for meshes of triangles that were built rather than scanned.

#include "scene/mesh.h"

namespace imgeo {

/// The mesh, which has no normals, with normals: smooth across edges of at most
/// `creaseAngle` radians, sharp across others. Positions of equal bits become one,
/// since what shares no vertex in a file may still share an edge.
Mesh withCreaseNormals(const Mesh& mesh, double creaseAngle);

} // namespace imgeo
