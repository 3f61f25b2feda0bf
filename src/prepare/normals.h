#pragma once
// Vertex normals for meshes that bring none.

#include "scene/mesh.h"

namespace imgeo {

enum class NormalWeighting {
  area,    ///< each triangle counts by its area (the default; what `compact` can predict)
  angle,   ///< by its angle at the corner (Thürmer & Wüthrich 1998)
  uniform, ///< each triangle counts once (Gouraud 1971)
};

/// Gives every position of a triangle mesh one smooth normal, summed in double
/// precision; a position without any area around it gets (0, 0, 1). Replaces
/// the mesh's normals; wedges that then differ in nothing should be welded.
void computeNormals(Mesh& mesh, NormalWeighting weighting);

} // namespace imgeo
