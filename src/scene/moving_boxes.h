#pragma once
// Boxes around shapes whose vertices move.

#include "scene/scene.h"

namespace imgeo {

/// Sets Shape::movingBox of all shapes with joints or displacers: around the vertices at rest and in all animations.
void setMovingBoxes(Scene& scene);

} // namespace imgeo
