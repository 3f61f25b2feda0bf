#pragma once
// Smooth vertex normals for meshes without normals.

#include "imgeo/preparation.h"
#include "scene/mesh.h"

namespace imgeo {

/// Gives every position of a triangle mesh one smooth normal, summed in double precision. A position whose sum is zero
/// gets (0, 0, 1). Replaces the mesh's normals. Wedges may be equal afterwards; the caller welds them.
void computeNormals(Mesh& mesh, NormalWeighting weighting);

} // namespace imgeo
