#pragma once
// The bounding box of a scene in world coordinates.

#include "documents/documents.h"

namespace imgeo {

struct WorldBox {
  Box3d box;                        ///< of the shapes that can be drawn; empty if there are none
  std::size_t undrawableShapes = 0; ///< scaled or moved beyond the range of single precision
};

/// The box of all shape instances that can be drawn.
WorldBox worldBoxOf(const SceneDocument& document);

} // namespace imgeo
