#pragma once
// KHR_materials_* as extensions of PhysicalMaterial.

#include "import/gltf/value.h"
#include "scene/appearance.h"

#include <span>

namespace imgeo::gltf {

/// The extensions that are not in their default state, or have textures, in the order of MaterialExtension.
/// `extensions` is the member of a material. Throws Error{malformed} for wrong types; factors out of range are clamped.
std::vector<MaterialExtension> readMaterialExtensions(const Value& extensions);

/// An index of refraction for surfaces that reflect all light.
inline constexpr float totalReflection = 1000;

/// A texture of an extension: a member of its object.
struct ExtensionTexture {
  const char* extension;
  const char* member;
  TextureRole role;
};
std::span<const ExtensionTexture> extensionTextures();

} // namespace imgeo::gltf
