#pragma once
// What glTF has in place of X3D's materials.

#include "scene/appearance.h"

namespace imgeo {

/// The material of glTF that stands for a material: a rough dielectric for an X3D Material, others unchanged. With
/// `hasColors`, of a mesh with vertex colours: in X3D they replace the diffuse colour, in glTF they multiply it.
AnyMaterial gltfMaterialOf(const AnyMaterial& material, bool hasColors);

} // namespace imgeo
