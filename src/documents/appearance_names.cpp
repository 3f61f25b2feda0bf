#include "documents/appearance_names.h"

namespace imgeo {

namespace {

constexpr const char* nearestPixel = "NEAREST_PIXEL";
constexpr const char* averagePixel = "AVG_PIXEL";
constexpr std::string_view nearestMipMap = "_NEAREST_MIPMAP", averageMipMap = "_AVG_MIPMAP";

} // namespace

std::string magnificationFilter(const Texture& texture) {
  return texture.magnification == Filter::nearest ? nearestPixel : averagePixel;
}

std::string minificationFilter(const Texture& texture) {
  std::string name = texture.minification == Filter::nearest ? nearestPixel : averagePixel;
  if (texture.mipMaps)
    name += texture.betweenMipMaps == Filter::nearest ? nearestMipMap : averageMipMap;
  return name;
}

void setMagnificationFilter(Texture& texture, std::string_view name) {
  if (equalIgnoringCase(name, nearestPixel))
    texture.magnification = Filter::nearest;
  if (equalIgnoringCase(name, averagePixel))
    texture.magnification = Filter::linear;
}

void setMinificationFilter(Texture& texture, std::string_view name) {
  for (const bool nearest : {true, false}) {
    const std::string_view prefix = nearest ? nearestPixel : averagePixel;
    if (name.size() < prefix.size() || !equalIgnoringCase(name.substr(0, prefix.size()), prefix))
      continue;
    const std::string_view suffix = name.substr(prefix.size());
    const bool isBetweenNearest = equalIgnoringCase(suffix, nearestMipMap),
               isBetweenAverage = equalIgnoringCase(suffix, averageMipMap);
    if (!suffix.empty() && !isBetweenNearest && !isBetweenAverage)
      continue;
    texture.minification = nearest ? Filter::nearest : Filter::linear;
    texture.mipMaps = !suffix.empty();
    texture.betweenMipMaps = isBetweenNearest ? Filter::nearest : isBetweenAverage ? Filter::linear : Filter::standard;
  }
}

std::string textureField(const AnyMaterial& material, TextureRole role) {
  const bool isPhong = std::holds_alternative<Material>(material),
             isPhysical = std::holds_alternative<PhysicalMaterial>(material);
  switch (role) {
  case TextureRole::color:
    return isPhong ? "diffuseTexture" : isPhysical ? "baseTexture" : "emissiveTexture";
  case TextureRole::emissive:
    return isPhong || isPhysical ? "emissiveTexture" : "";
  case TextureRole::metallicRoughness:
    return isPhysical ? "metallicRoughnessTexture" : "";
  case TextureRole::normal:
    return "normalTexture";
  case TextureRole::occlusion:
    return isPhong || isPhysical ? "occlusionTexture" : "";
  case TextureRole::ambient:
    return isPhong ? "ambientTexture" : "";
  case TextureRole::specular:
    return isPhong ? "specularTexture" : "";
  case TextureRole::shininess:
    return isPhong ? "shininessTexture" : "";
  default:
    return "";
  }
}

std::string textureField(const MaterialExtension& extension, TextureRole role) {
  struct Row {
    std::size_t kind;
    TextureRole role;
    const char* field;
  };
  const auto kindOf = [](const MaterialExtension& any) { return any.index(); };
  static const Row rows[] = {
      {kindOf(AnisotropyMaterialExtension{}), TextureRole::anisotropy, "anisotropyTexture"},
      {kindOf(ClearcoatMaterialExtension{}), TextureRole::clearcoat, "clearcoatTexture"},
      {kindOf(ClearcoatMaterialExtension{}), TextureRole::clearcoatRoughness, "clearcoatRoughnessTexture"},
      {kindOf(ClearcoatMaterialExtension{}), TextureRole::clearcoatNormal, "clearcoatNormalTexture"},
      {kindOf(IridescenceMaterialExtension{}), TextureRole::iridescence, "iridescenceTexture"},
      {kindOf(IridescenceMaterialExtension{}), TextureRole::iridescenceThickness, "iridescenceThicknessTexture"},
      {kindOf(SheenMaterialExtension{}), TextureRole::sheenColor, "sheenColorTexture"},
      {kindOf(SheenMaterialExtension{}), TextureRole::sheenRoughness, "sheenRoughnessTexture"},
      {kindOf(SpecularMaterialExtension{}), TextureRole::specularStrength, "specularTexture"},
      {kindOf(SpecularMaterialExtension{}), TextureRole::specularColor, "specularColorTexture"},
      {kindOf(TransmissionMaterialExtension{}), TextureRole::transmission, "transmissionTexture"},
      {kindOf(VolumeMaterialExtension{}), TextureRole::thickness, "thicknessTexture"},
  };
  for (const Row& row : rows)
    if (row.kind == extension.index() && row.role == role)
      return row.field;
  return "";
}

} // namespace imgeo
