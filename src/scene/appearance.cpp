#include "scene/appearance.h"

#include "scene/color.h"

#include <algorithm>

namespace imgeo {

namespace {

Vec3f srgbOf(Vec3f linear) {
  const auto encode = [](float value) { return static_cast<float>(srgbOfLinear(std::clamp(value, 0.0f, 1.0f))); };
  return {encode(linear.x), encode(linear.y), encode(linear.z)};
}

Material phongOf(const PhysicalMaterial& material) {
  // glTF 2.0, appendix B: a dielectric has a specular reflectance of 0.04, a metal that of its base colour and no
  // diffuse reflection. Since a metal would be black without an environment map, half of its colour stays diffuse.
  const Vec3f base = material.baseColor;
  const float metallic = std::clamp(material.metallic, 0.0f, 1.0f);
  const float smoothness = 1 - std::clamp(material.roughness, 0.0f, 1.0f);
  Material phong;
  phong.diffuseColor = srgbOf(base * (1 - metallic / 2));
  const float dielectric = 0.04f * (1 - metallic);
  phong.specularColor = srgbOf((base * metallic + Vec3f{dielectric, dielectric, dielectric}) * smoothness);
  phong.emissiveColor = srgbOf(material.emissiveColor);
  phong.shininess = std::max(smoothness, 0.01f);
  phong.transparency = material.transparency;
  return phong;
}

Material phongOf(const UnlitMaterial& material) {
  Material phong;
  phong.diffuseColor = {0, 0, 0};
  phong.ambientIntensity = 0;
  phong.emissiveColor = material.emissiveColor;
  phong.transparency = material.transparency;
  return phong;
}

Material phongOf(const Material& material) {
  return material;
}

} // namespace

Material phongOf(const AnyMaterial& material) {
  return std::visit([](const auto& any) { return phongOf(any); }, material);
}

} // namespace imgeo
