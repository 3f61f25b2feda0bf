#pragma once
// What a scene fills of the world, for the camera that is to see it whole.

#include "documents/documents.h"

namespace imgeo {

struct WorldBox {
  Box3d box;                    ///< of the shapes that can be drawn; empty where there are none
  std::size_t absurdShapes = 0; ///< scaled or moved beyond what single precision tells apart
};

WorldBox worldBoxOf(const SceneDocument& document);

} // namespace imgeo
