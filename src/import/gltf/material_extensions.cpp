#include "import/gltf/material_extensions.h"

#include <algorithm>
#include <limits>

namespace imgeo::gltf {

namespace {

constexpr ExtensionTexture textureRows[] = {
    {"KHR_materials_anisotropy", "anisotropyTexture", TextureRole::anisotropy},
    {"KHR_materials_clearcoat", "clearcoatTexture", TextureRole::clearcoat},
    {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", TextureRole::clearcoatRoughness},
    {"KHR_materials_clearcoat", "clearcoatNormalTexture", TextureRole::clearcoatNormal},
    {"KHR_materials_iridescence", "iridescenceTexture", TextureRole::iridescence},
    {"KHR_materials_iridescence", "iridescenceThicknessTexture", TextureRole::iridescenceThickness},
    {"KHR_materials_sheen", "sheenColorTexture", TextureRole::sheenColor},
    {"KHR_materials_sheen", "sheenRoughnessTexture", TextureRole::sheenRoughness},
    {"KHR_materials_specular", "specularTexture", TextureRole::specularStrength},
    {"KHR_materials_specular", "specularColorTexture", TextureRole::specularColor},
    {"KHR_materials_transmission", "transmissionTexture", TextureRole::transmission},
    {"KHR_materials_volume", "thicknessTexture", TextureRole::thickness},
};

/// Reads the members of one extension.
class Members {
public:
  explicit Members(const Value& extension) : extension_(extension) {}

  /// A number in a range; the fallback where it is absent.
  float number(const char* name, double fallback, double min, double max) const {
    return static_cast<float>(std::clamp(extension_[name].real(fallback), min, max));
  }
  float unit(const char* name, double fallback = 0) const { return number(name, fallback, 0, 1); }
  float positive(const char* name, double fallback = 0) const {
    return number(name, fallback, 0, std::numeric_limits<float>::max());
  }
  Vec3f color(const char* name, Vec3f fallback) const { return extension_[name].vec3f(fallback); }

private:
  Value extension_;
};

class ExtensionList {
public:
  explicit ExtensionList(const Value& extensions) : extensions_(extensions) {}

  /// Adds what `read` makes of the extension `name`, if the material has it.
  template <typename Read> void add(const char* name, const Read& read) {
    const Value value = extensions_[name];
    if (value.isAbsent())
      return;
    const auto extension = read(Members(value));
    const bool hasTexture = std::ranges::any_of(textureRows, [&](const ExtensionTexture& row) {
      return std::string_view(row.extension) == name && value.has(row.member);
    });
    if (hasTexture || extension != std::remove_cvref_t<decltype(extension)>{})
      list.push_back(extension);
  }

  std::vector<MaterialExtension> list;

private:
  Value extensions_;
};

/// KHR_materials_ior: 0 stands for total reflection.
float indexOfRefractionOf(const Members& members) {
  const float index = members.positive("ior", 1.5);
  return index == 0 ? totalReflection : std::max(index, 1.0f);
}

} // namespace

std::span<const ExtensionTexture> extensionTextures() {
  return textureRows;
}

std::vector<MaterialExtension> readMaterialExtensions(const Value& extensions) {
  ExtensionList all(extensions);
  all.add("KHR_materials_anisotropy", [](const Members& m) {
    return AnisotropyMaterialExtension{m.unit("anisotropyStrength"), m.number("anisotropyRotation", 0, -1e6, 1e6)};
  });
  all.add("KHR_materials_clearcoat", [](const Members& m) {
    return ClearcoatMaterialExtension{m.unit("clearcoatFactor"), m.unit("clearcoatRoughnessFactor")};
  });
  all.add("KHR_materials_dispersion",
          [](const Members& m) { return DispersionMaterialExtension{m.positive("dispersion")}; });
  all.add("KHR_materials_emissive_strength",
          [](const Members& m) { return EmissiveStrengthMaterialExtension{m.positive("emissiveStrength", 1)}; });
  all.add("KHR_materials_ior", [](const Members& m) { return IORMaterialExtension{indexOfRefractionOf(m)}; });
  all.add("KHR_materials_iridescence", [](const Members& m) {
    return IridescenceMaterialExtension{m.unit("iridescenceFactor"), std::max(m.positive("iridescenceIor", 1.3), 1.0f),
                                        m.positive("iridescenceThicknessMinimum", 100),
                                        m.positive("iridescenceThicknessMaximum", 400)};
  });
  all.add("KHR_materials_sheen", [](const Members& m) {
    return SheenMaterialExtension{m.color("sheenColorFactor", {0, 0, 0}), m.unit("sheenRoughnessFactor")};
  });
  all.add("KHR_materials_specular", [](const Members& m) {
    return SpecularMaterialExtension{m.unit("specularFactor", 1), m.color("specularColorFactor", {1, 1, 1})};
  });
  all.add("KHR_materials_transmission",
          [](const Members& m) { return TransmissionMaterialExtension{m.unit("transmissionFactor")}; });
  all.add("KHR_materials_volume", [](const Members& m) {
    VolumeMaterialExtension volume;
    volume.thickness = m.positive("thicknessFactor");
    if (const float distance = m.positive("attenuationDistance"); distance > 0)
      volume.attenuationDistance = distance;
    volume.attenuationColor = m.color("attenuationColor", {1, 1, 1});
    return volume;
  });
  return std::move(all.list);
}

} // namespace imgeo::gltf
