#pragma once
// X3D's names for the enumerations of an appearance, and for the fields of its textures, for the writer and the reader.

#include "markup/find_x3d.h"
#include "scene/appearance.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace imgeo {

inline constexpr std::array alphaModeNames{"AUTO", "OPAQUE", "MASK", "BLEND"};
inline constexpr std::array boundaryNames{"REPEAT", "CLAMP_TO_EDGE", "MIRRORED_REPEAT"};
inline constexpr std::array textureRoleNames{"color",
                                             "emissive",
                                             "metallicRoughness",
                                             "normal",
                                             "occlusion",
                                             "ambient",
                                             "specular",
                                             "shininess",
                                             "anisotropy",
                                             "clearcoat",
                                             "clearcoatRoughness",
                                             "clearcoatNormal",
                                             "iridescence",
                                             "iridescenceThickness",
                                             "sheenColor",
                                             "sheenRoughness",
                                             "specularStrength",
                                             "specularColor",
                                             "transmission",
                                             "thickness"};
static_assert(textureRoleNames.size() == textureRoleCount);

/// The elements of the extensions of PhysicalMaterial, in the order of MaterialExtension.
inline constexpr std::array materialExtensionNames{"AnisotropyMaterialExtension",   "ClearcoatMaterialExtension",
                                                   "DispersionMaterialExtension",   "EmissiveStrengthMaterialExtension",
                                                   "IORMaterialExtension",          "IridescenceMaterialExtension",
                                                   "SheenMaterialExtension",        "SpecularMaterialExtension",
                                                   "TransmissionMaterialExtension", "VolumeMaterialExtension"};
static_assert(materialExtensionNames.size() == std::variant_size_v<MaterialExtension>);

inline const char* nameOf(AlphaMode mode) {
  return alphaModeNames.at(static_cast<std::size_t>(mode));
}
inline const char* nameOf(Boundary boundary) {
  return boundaryNames.at(static_cast<std::size_t>(boundary));
}
/// The mapping of the texture in a role (X3D 4, 18.4: `mapping` fields).
inline const char* nameOf(TextureRole role) {
  return textureRoleNames.at(static_cast<std::size_t>(role));
}

/// The value with the name `name`, without regard to case.
template <typename Value, std::size_t count>
std::optional<Value> valueNamed(const std::array<const char*, count>& names, std::string_view name) {
  for (std::size_t i = 0; i < count; ++i)
    if (equalIgnoringCase(names[i], name))
      return static_cast<Value>(i);
  return {};
}

/// The material's own field for the texture of a role; "" if the kind of material has none.
std::string textureField(const AnyMaterial& material, TextureRole role);
/// The extension's field for the texture of a role; "" if the extension has none.
std::string textureField(const MaterialExtension& extension, TextureRole role);

/// X3D's names for the filters of TextureProperties. The setters ignore unknown names.
std::string magnificationFilter(const Texture& texture);
std::string minificationFilter(const Texture& texture);
void setMagnificationFilter(Texture& texture, std::string_view name);
void setMinificationFilter(Texture& texture, std::string_view name);

} // namespace imgeo
