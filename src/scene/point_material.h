#pragma once
// The material of points and lines, which X3D does not light.

#include "scene/appearance.h"

namespace imgeo {

/// The material with which points and lines show what `material` shows on a surface: they have vertex colours or the
/// emissive colour, which is the diffuse colour where the material has none.
Material pointMaterialOf(const AnyMaterial& material);

} // namespace imgeo
