#pragma once
// The bounding box of a scene in world coordinates.

#include "documents/documents.h"

#include <string>

namespace imgeo {

struct WorldBox {
  Box3d box;                        ///< of the shapes that can be drawn; empty if there are none
  std::size_t undrawableShapes = 0; ///< scaled or moved beyond the range of single precision
};

/// The box of all shape instances that can be drawn.
WorldBox worldBoxOf(const SceneDocument& document);

/// Throws Error{limit} with `location` for a box that pages cannot draw: cameras around it, squares of lengths and
/// determinants of matrices would leave the range of single precision.
void requireDrawable(const Box3d& worldBox, const std::string& location);

} // namespace imgeo
