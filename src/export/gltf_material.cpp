#include "export/gltf_material.h"

#include "scene/gltf_material_of.h"

#include <cmath>

namespace imgeo {

namespace {

Json pbrOf(Vec3f linearColor, float transparency, float metallic, float roughness) {
  return {{"baseColorFactor", {linearColor.x, linearColor.y, linearColor.z, 1 - transparency}},
          {"metallicFactor", metallic},
          {"roughnessFactor", roughness}};
}

Json jsonOf(Vec3f vector) {
  return {vector.x, vector.y, vector.z};
}

struct MaterialJson {
  Json json;
  float transparency = 0;

  void operator()(const PhysicalMaterial& material) {
    json["pbrMetallicRoughness"] =
        pbrOf(material.baseColor, material.transparency, material.metallic, material.roughness);
    addEmissive(material.emissiveColor);
    transparency = material.transparency;
    for (const MaterialExtension& extension : material.extensions)
      std::visit(*this, extension);
  }
  void operator()(const AnisotropyMaterialExtension& extension) {
    json["extensions"]["KHR_materials_anisotropy"] = {{"anisotropyStrength", extension.anisotropyStrength},
                                                      {"anisotropyRotation", extension.anisotropyRotation}};
  }
  void operator()(const ClearcoatMaterialExtension& extension) {
    json["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", extension.clearcoat},
                                                     {"clearcoatRoughnessFactor", extension.clearcoatRoughness}};
  }
  void operator()(const DispersionMaterialExtension& extension) {
    json["extensions"]["KHR_materials_dispersion"] = {{"dispersion", extension.dispersion}};
  }
  void operator()(const EmissiveStrengthMaterialExtension& extension) {
    json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", extension.emissiveStrength}};
  }
  void operator()(const IORMaterialExtension& extension) {
    json["extensions"]["KHR_materials_ior"] = {{"ior", extension.indexOfRefraction}};
  }
  void operator()(const IridescenceMaterialExtension& extension) {
    json["extensions"]["KHR_materials_iridescence"] = {
        {"iridescenceFactor", extension.iridescence},
        {"iridescenceIor", extension.iridescenceIndexOfRefraction},
        {"iridescenceThicknessMinimum", extension.iridescenceThicknessMinimum},
        {"iridescenceThicknessMaximum", extension.iridescenceThicknessMaximum}};
  }
  void operator()(const SheenMaterialExtension& extension) {
    json["extensions"]["KHR_materials_sheen"] = {{"sheenColorFactor", jsonOf(extension.sheenColor)},
                                                 {"sheenRoughnessFactor", extension.sheenRoughness}};
  }
  void operator()(const SpecularMaterialExtension& extension) {
    json["extensions"]["KHR_materials_specular"] = {{"specularFactor", extension.specular},
                                                    {"specularColorFactor", jsonOf(extension.specularColor)}};
  }
  void operator()(const TransmissionMaterialExtension& extension) {
    json["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", extension.transmission}};
  }
  void operator()(const VolumeMaterialExtension& extension) {
    json["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", extension.thickness},
                                                  {"attenuationDistance", extension.attenuationDistance},
                                                  {"attenuationColor", jsonOf(extension.attenuationColor)}};
  }
  void operator()(const UnlitMaterial& material) {
    json["pbrMetallicRoughness"] = pbrOf(linearOf(material.emissiveColor), material.transparency, 0, 1);
    json["extensions"]["KHR_materials_unlit"] = Json::object();
    transparency = material.transparency;
  }
  void addEmissive(Vec3f linearColor) {
    if (linearColor != Vec3f{})
      json["emissiveFactor"] = jsonOf(linearColor);
  }
};

/// KHR_texture_transform of an X3D TextureTransform (ISO/IEC 19775-1, 18.4.9); v of glTF points down. Returns null for
/// non-uniform scale with rotation: glTF scales before it rotates, X3D after.
Json gltfTransform(const TextureTransform& transform) {
  const double c = std::cos(transform.rotation), s = std::sin(transform.rotation);
  const bool isUniform = transform.scale.x == transform.scale.y;
  if (!isUniform && transform.rotation != 0)
    return {};
  const Vec2<double> moved{transform.translation.x + transform.center.x, transform.translation.y + transform.center.y};
  const double x = (c * moved.x - s * moved.y) * transform.scale.x - transform.center.x,
               y = (s * moved.x + c * moved.y) * transform.scale.y - transform.center.y;
  // X3D's coordinates t = 1 - v and t' = 1 - v' point up: t' = s sx u + c sy t + y.
  Json json;
  json["offset"] = {x - s * transform.scale.x, 1 - y - c * transform.scale.y};
  json["scale"] = {transform.scale.x, transform.scale.y};
  if (transform.rotation != 0)
    json["rotation"] = transform.rotation;
  return json;
}

void addExtensionTexture(Json& extensions, TextureRole role, Json info) {
  struct Row {
    TextureRole role;
    const char* extension;
    const char* member;
  };
  static constexpr Row rows[] = {
      {TextureRole::anisotropy, "KHR_materials_anisotropy", "anisotropyTexture"},
      {TextureRole::clearcoat, "KHR_materials_clearcoat", "clearcoatTexture"},
      {TextureRole::clearcoatRoughness, "KHR_materials_clearcoat", "clearcoatRoughnessTexture"},
      {TextureRole::clearcoatNormal, "KHR_materials_clearcoat", "clearcoatNormalTexture"},
      {TextureRole::iridescence, "KHR_materials_iridescence", "iridescenceTexture"},
      {TextureRole::iridescenceThickness, "KHR_materials_iridescence", "iridescenceThicknessTexture"},
      {TextureRole::sheenColor, "KHR_materials_sheen", "sheenColorTexture"},
      {TextureRole::sheenRoughness, "KHR_materials_sheen", "sheenRoughnessTexture"},
      {TextureRole::specularStrength, "KHR_materials_specular", "specularTexture"},
      {TextureRole::specularColor, "KHR_materials_specular", "specularColorTexture"},
      {TextureRole::transmission, "KHR_materials_transmission", "transmissionTexture"},
      {TextureRole::thickness, "KHR_materials_volume", "thicknessTexture"},
  };
  for (const Row& row : rows)
    if (row.role == role) {
      extensions[row.extension][row.member] = std::move(info);
      return;
    }
}

void addTexture(Json& material, const TextureUse& use, std::size_t index, std::size_t texCoordSet,
                const AnyMaterial& x3dMaterial) {
  Json info{{"index", index}};
  if (texCoordSet > 0)
    info["texCoord"] = texCoordSet;
  if (use.transform != TextureTransform{})
    if (const Json transform = gltfTransform(use.transform); !transform.is_null())
      info["extensions"]["KHR_texture_transform"] = transform;
  const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&x3dMaterial);
  switch (use.role) {
  case TextureRole::color:
    material["pbrMetallicRoughness"]["baseColorTexture"] = std::move(info);
    break;
  case TextureRole::emissive:
    material["emissiveTexture"] = std::move(info);
    break;
  case TextureRole::metallicRoughness:
    material["pbrMetallicRoughness"]["metallicRoughnessTexture"] = std::move(info);
    break;
  case TextureRole::normal:
    if (physical && physical->normalScale != 1)
      info["scale"] = physical->normalScale;
    material["normalTexture"] = std::move(info);
    break;
  case TextureRole::occlusion:
    if (physical && physical->occlusionStrength != 1)
      info["strength"] = physical->occlusionStrength;
    material["occlusionTexture"] = std::move(info);
    break;
  case TextureRole::ambient:
  case TextureRole::specular:
  case TextureRole::shininess:
    break; // glTF has no such textures
  default:
    addExtensionTexture(material["extensions"], use.role, std::move(info));
  }
}

} // namespace

Json gltfMaterial(const Appearance& appearance, const Shape& shape, const Mesh& mesh,
                  const TextureIndex& textureIndex) {
  MaterialJson material;
  std::visit(material, gltfMaterialOf(appearance.material, !mesh.colors.empty()));
  Json& json = material.json;
  if (!appearance.name.empty())
    json["name"] = appearance.name;
  for (const TextureUse& use : appearance.textures)
    if (const std::optional<std::size_t> index = textureIndex(use.texture))
      addTexture(json, use, *index, texCoordSetNamed(use.mapping, mesh), appearance.material);
  const bool isTransparent = material.transparency > 0 || (!mesh.colors.empty() && mesh.colorComponents == 4);
  if (appearance.alphaMode == AlphaMode::mask) {
    json["alphaMode"] = "MASK";
    json["alphaCutoff"] = appearance.alphaCutoff;
  } else if (appearance.alphaMode == AlphaMode::blend ||
             (appearance.alphaMode == AlphaMode::automatic && isTransparent)) {
    json["alphaMode"] = "BLEND";
  }
  if (!shape.solid)
    json["doubleSided"] = true;
  return json;
}

Json gltfSampler(const Texture& texture) {
  constexpr int repeat = 10497, clampToEdge = 33071, mirroredRepeat = 33648, nearest = 9728, linear = 9729;
  constexpr int boundaries[] = {repeat, clampToEdge, mirroredRepeat};
  Json json{{"wrapS", boundaries[static_cast<std::size_t>(texture.boundaryS)]},
            {"wrapT", boundaries[static_cast<std::size_t>(texture.boundaryT)]}};
  if (texture.magnification != Filter::standard)
    json["magFilter"] = texture.magnification == Filter::nearest ? nearest : linear;
  if (texture.minification != Filter::standard) {
    const int within = texture.minification == Filter::nearest ? 0 : 1,
              between = texture.betweenMipMaps == Filter::nearest ? 0 : 2;
    constexpr int firstWithMipMaps = 9984;
    json["minFilter"] = texture.mipMaps ? firstWithMipMaps + within + between : nearest + within;
  }
  return json;
}

} // namespace imgeo
