#pragma once
// Extensions of PhysicalMaterial: the nodes that X_ITE defines for glTF's KHR_materials_*, with its names and defaults.
// Colours are linear. Their textures are TextureUses of the appearance.

#include "base/vec.h"

#include <variant>

namespace imgeo {

/// KHR_materials_anisotropy.
struct AnisotropyMaterialExtension {
  float anisotropyStrength = 0; ///< 0..1
  float anisotropyRotation = 0; ///< radians, from the tangent towards the bitangent
  friend bool operator==(const AnisotropyMaterialExtension&, const AnisotropyMaterialExtension&) = default;
};

/// KHR_materials_clearcoat.
struct ClearcoatMaterialExtension {
  float clearcoat = 0, clearcoatRoughness = 0; ///< 0..1
  friend bool operator==(const ClearcoatMaterialExtension&, const ClearcoatMaterialExtension&) = default;
};

/// KHR_materials_dispersion.
struct DispersionMaterialExtension {
  float dispersion = 0; ///< 20 over the Abbe number
  friend bool operator==(const DispersionMaterialExtension&, const DispersionMaterialExtension&) = default;
};

/// KHR_materials_emissive_strength.
struct EmissiveStrengthMaterialExtension {
  float emissiveStrength = 1; ///< factor of the emissive colour
  friend bool operator==(const EmissiveStrengthMaterialExtension&, const EmissiveStrengthMaterialExtension&) = default;
};

/// KHR_materials_ior.
struct IORMaterialExtension {
  float indexOfRefraction = 1.5f; ///< from 1 on
  friend bool operator==(const IORMaterialExtension&, const IORMaterialExtension&) = default;
};

/// KHR_materials_iridescence.
struct IridescenceMaterialExtension {
  float iridescence = 0; ///< 0..1
  float iridescenceIndexOfRefraction = 1.3f;
  float iridescenceThicknessMinimum = 100, iridescenceThicknessMaximum = 400; ///< of the film, in nanometres
  friend bool operator==(const IridescenceMaterialExtension&, const IridescenceMaterialExtension&) = default;
};

/// KHR_materials_sheen.
struct SheenMaterialExtension {
  Vec3f sheenColor{0, 0, 0};
  float sheenRoughness = 0; ///< 0..1
  friend bool operator==(const SheenMaterialExtension&, const SheenMaterialExtension&) = default;
};

/// KHR_materials_specular.
struct SpecularMaterialExtension {
  float specular = 1; ///< 0..1
  Vec3f specularColor{1, 1, 1};
  friend bool operator==(const SpecularMaterialExtension&, const SpecularMaterialExtension&) = default;
};

/// KHR_materials_transmission.
struct TransmissionMaterialExtension {
  float transmission = 0; ///< 0..1
  friend bool operator==(const TransmissionMaterialExtension&, const TransmissionMaterialExtension&) = default;
};

/// KHR_materials_volume.
struct VolumeMaterialExtension {
  float thickness = 0;                 ///< in the shape's own units; 0: a thin surface
  float attenuationDistance = 1000000; ///< in scene units
  Vec3f attenuationColor{1, 1, 1};     ///< what is left of white light after that distance
  friend bool operator==(const VolumeMaterialExtension&, const VolumeMaterialExtension&) = default;
};

using MaterialExtension =
    std::variant<AnisotropyMaterialExtension, ClearcoatMaterialExtension, DispersionMaterialExtension,
                 EmissiveStrengthMaterialExtension, IORMaterialExtension, IridescenceMaterialExtension,
                 SheenMaterialExtension, SpecularMaterialExtension, TransmissionMaterialExtension,
                 VolumeMaterialExtension>;

} // namespace imgeo
