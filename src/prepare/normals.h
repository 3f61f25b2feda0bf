#pragma once
// Vertex normals for meshes without normals.

#include "imgeo/preparation.h"
#include "scene/mesh.h"

namespace imgeo {

/// Gives the vertices of a triangle mesh normals, which replace its own. Triangles around a position share one, summed
/// in double precision, unless edges at which they meet at more than mesh.creaseDegrees, if it states an angle, divide
/// them; such a position gets more wedges. Edges of more than 16 triangles divide them, too. Where a sum is zero, the
/// normal is (0, 0, 1). Wedges may be equal afterwards, but for meshes with a crease angle; the caller welds them.
void computeNormals(Mesh& mesh, NormalWeighting weighting);

} // namespace imgeo
