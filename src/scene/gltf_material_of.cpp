#include "scene/gltf_material_of.h"

#include "scene/color.h"

namespace imgeo {

Vec3f linearOf(Vec3f srgb) {
  return {static_cast<float>(linearOfSrgb(srgb.x)), static_cast<float>(linearOfSrgb(srgb.y)),
          static_cast<float>(linearOfSrgb(srgb.z))};
}

namespace {

GltfMaterial withoutColors(const AnyMaterial& material) {
  if (const Material* phong = std::get_if<Material>(&material))
    return PhysicalMaterial{.baseColor = linearOf(phong->diffuseColor),
                            .emissiveColor = linearOf(phong->emissiveColor),
                            .metallic = 0,
                            .roughness = 1 - phong->shininess,
                            .transparency = phong->transparency};
  if (const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&material))
    return *physical;
  return std::get<UnlitMaterial>(material);
}

} // namespace

GltfMaterial gltfMaterialOf(const AnyMaterial& material, bool hasColors) {
  GltfMaterial result = withoutColors(material);
  if (PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&result); physical && hasColors)
    physical->baseColor = {1, 1, 1};
  if (UnlitMaterial* unlit = std::get_if<UnlitMaterial>(&result); unlit && hasColors)
    unlit->emissiveColor = {1, 1, 1};
  return result;
}

} // namespace imgeo
