#pragma once
// What glTF has instead of X3D's materials.

#include "scene/appearance.h"

#include <variant>

namespace imgeo {

using GltfMaterial = std::variant<PhysicalMaterial, UnlitMaterial>;

/// An sRGB colour in linear light, as glTF states colours.
Vec3f linearOf(Vec3f srgb);

/// The material of glTF that stands for a material: a rough dielectric for an X3D Material, others unchanged. With
/// `hasColors`, of a mesh with vertex colours: in X3D they replace the diffuse colour, in glTF they multiply it.
GltfMaterial gltfMaterialOf(const AnyMaterial& material, bool hasColors);

} // namespace imgeo
