#pragma once
// Smooth vertex normals for meshes without normals.

#include "scene/mesh.h"

namespace imgeo {

enum class NormalWeighting {
  area,    ///< weighted by the area of the triangle (the default; `compact` predicts such normals)
  angle,   ///< weighted by the angle at the corner (Thürmer & Wüthrich 1998)
  uniform, ///< unweighted (Gouraud 1971)
};

/// Gives every position of a triangle mesh one smooth normal, summed in double precision. A position whose sum is zero
/// gets (0, 0, 1). Replaces the mesh's normals. Wedges may be equal afterwards; the caller welds them.
void computeNormals(Mesh& mesh, NormalWeighting weighting);

} // namespace imgeo
