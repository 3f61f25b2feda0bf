#include "import/gltf/materials.h"

#include "images/decode_image.h"
#include "images/encode_image.h"
#include "import/gltf/primitive.h"
#include "import/mesh/texcoord_mapping.h"
#include "import/source_images.h"
#include "scene/color.h"

#include <array>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::gltf {

namespace {

float saturate(double value) {
  return static_cast<float>(std::clamp(value, 0.0, 1.0));
}

Vec3f encodedSrgb(Vec3d linear) {
  const auto encode = [](double v) { return static_cast<float>(srgbOfLinear(std::clamp(v, 0.0, 1.0))); };
  return {encode(linear.x), encode(linear.y), encode(linear.z)};
}

/// KHR_materials_pbrSpecularGlossiness as a PhysicalMaterial: a dielectric whose reflectance is the specular colour,
/// since that of an index of refraction of 1000 is 1.
PhysicalMaterial specularGlossinessOf(const Value& value) {
  PhysicalMaterial material;
  const std::vector<double> diffuse = value["diffuseFactor"].reals(4, {1, 1, 1, 1});
  material.baseColor = Vec3f(Vec3d{diffuse[0], diffuse[1], diffuse[2]});
  material.transparency = 1 - saturate(diffuse[3]);
  material.metallic = 0;
  material.roughness = 1 - saturate(value["glossinessFactor"].real(1));
  material.extensions = {IORMaterialExtension{totalReflection},
                         SpecularMaterialExtension{1, Vec3f(value["specularFactor"].vec3({1, 1, 1}))}};
  return material;
}

Filter filterOf(std::uint64_t value) {
  constexpr std::uint64_t nearest = 9728, linear = 9729;
  return value == nearest ? Filter::nearest : value == linear ? Filter::linear : Filter::standard;
}

Boundary boundaryOf(std::uint64_t value) {
  constexpr std::uint64_t clampToEdge = 33071, mirroredRepeat = 33648;
  return value == clampToEdge ? Boundary::clamp : value == mirroredRepeat ? Boundary::mirroredRepeat : Boundary::repeat;
}

void readSampler(const Value& value, Texture& texture) {
  texture.boundaryS = boundaryOf(value["wrapS"].whole(0));
  texture.boundaryT = boundaryOf(value["wrapT"].whole(0));
  texture.magnification = filterOf(value["magFilter"].whole(0));
  const std::uint64_t minification = value["minFilter"].whole(0);
  // 9984 to 9987 are the filters with mip maps: the filter within a level, then the one between levels.
  constexpr std::uint64_t firstWithMipMaps = 9984, lastWithMipMaps = 9987;
  texture.minification = filterOf(minification);
  texture.mipMaps = texture.minification == Filter::standard;
  if (minification >= firstWithMipMaps && minification <= lastWithMipMaps) {
    const std::uint64_t kind = minification - firstWithMipMaps;
    texture.minification = kind % 2 == 0 ? Filter::nearest : Filter::linear;
    texture.betweenMipMaps = kind / 2 == 0 ? Filter::nearest : Filter::linear;
  }
}

} // namespace

std::optional<TextureTransform> textureTransformOf(double a, double b, double c, double d, double x, double y) {
  // X3D composes the matrix of a rotation, then a scale.
  const double sizeS = std::hypot(a, c), sizeT = std::hypot(b, d);
  if (!(sizeS > 0) || !(sizeT > 0) || std::abs(a * b + c * d) > 1e-6 * sizeS * sizeT)
    return {};
  TextureTransform transform;
  const double rotation = std::atan2(-c, a), determinant = a * d - b * c;
  transform.rotation = static_cast<float>(rotation);
  transform.scale = {static_cast<float>(sizeS), static_cast<float>(determinant < 0 ? -sizeT : sizeT)};
  // The translation comes first in X3D: M (t + p) = M t + (x, y).
  transform.translation = {static_cast<float>((d * x - c * y) / determinant),
                           static_cast<float>((a * y - b * x) / determinant)};
  return transform;
}

TextureTransform MaterialReader::transformOf(const Value& extension) {
  if (extension.isAbsent())
    return {};
  const Vec2<double> offset = extension["offset"].vec2({0, 0}), scale = extension["scale"].vec2({1, 1});
  const double rotation = extension["rotation"].real(0), cosine = std::cos(rotation), sine = std::sin(rotation);
  // u' = cos sx u + sin sy v + x, v' = -sin sx u + cos sy v + y, where v is measured down; X3D measures t = 1 - v up.
  const double a = cosine * scale.x, b = sine * scale.x, c = -sine * scale.y, d = cosine * scale.y;
  const double x = offset.x + sine * scale.y, y = 1 - offset.y - cosine * scale.y;
  const std::optional<TextureTransform> transform = textureTransformOf(a, b, c, d, x, y);
  omissions.skewedTransforms += !transform;
  return transform.value_or(TextureTransform{});
}

std::optional<std::size_t> MaterialReader::image(std::size_t index) {
  const auto [found, isNew] = images_.try_emplace(index);
  if (!isNew)
    return found->second;
  const Value value = document_.array("images")[index];
  ImageFile image;
  try {
    image.url = value["uri"].text();
    if (const auto view = value.index("bufferView", document_.array("bufferViews"))) {
      const ByteSpan bytes = document_.view(*view);
      image.bytes.assign(bytes.begin(), bytes.end());
    } else {
      image.bytes = document_.references().fetch(image.url);
    }
    if (isDataUrl(image.url))
      image.url = "";
    requireImage(image.bytes, value.location());
  } catch (const Error& error) {
    if (isStrict_)
      throw faultOfSource(error);
    omissions.images.push_back(fmt::format("A texture is left out: {}.", error.what()));
    return {};
  }
  graph_.images.push_back(std::move(image));
  return found->second = graph_.images.size() - 1;
}

std::optional<std::size_t> MaterialReader::texture(std::size_t index) {
  const auto [found, isNew] = textures_.try_emplace(index);
  if (!isNew)
    return found->second;
  const Value value = document_.array("textures")[index], images = document_.array("images");
  std::optional<std::size_t> source;
  for (const char* extension : {"EXT_texture_avif", "EXT_texture_webp"})
    if (!source)
      source = value["extensions"][extension].index("source", images);
  if (!source)
    source = value.index("source", images);
  if (!source) {
    omissions.images.push_back(
        fmt::format("A texture is left out: {} has no image of a kind that browsers show.", value.location()));
    return {};
  }
  const std::optional<std::size_t> image = this->image(*source);
  if (!image)
    return {};
  Texture texture;
  texture.name = value["name"].text(document_.array("images")[*source]["name"].text());
  texture.image = *image;
  if (const auto sampler = value.index("sampler", document_.array("samplers")))
    readSampler(document_.array("samplers")[*sampler], texture);
  graph_.textures.push_back(std::move(texture));
  return found->second = graph_.textures.size() - 1;
}

void MaterialReader::addTexture(const Value& info, TextureRole role, Appearance& appearance) {
  const std::optional<std::size_t> index = info.index("index", document_.array("textures"));
  if (!index)
    return;
  const Value transform = info["extensions"]["KHR_texture_transform"];
  const std::size_t set = transform["texCoord"].whole(info["texCoord"].whole(0));
  const std::optional<std::size_t> texture = this->texture(*index);
  if (!texture)
    return;
  appearance.textures.push_back({role, *texture, transformOf(transform), mappingOf(set)});
  usedTexCoordSets_.insert(set);
}

AnyMaterial MaterialReader::materialOf(const Value& value) {
  const Value extensions = value["extensions"], pbr = value["pbrMetallicRoughness"];
  const std::vector<double> base = pbr["baseColorFactor"].reals(4, {1, 1, 1, 1});
  const float transparency = 1 - saturate(base[3]);
  if (extensions.has("KHR_materials_unlit"))
    return UnlitMaterial{encodedSrgb({base[0], base[1], base[2]}), transparency};
  const Value glossiness = extensions["KHR_materials_pbrSpecularGlossiness"];
  PhysicalMaterial material;
  if (!glossiness.isAbsent()) {
    material = specularGlossinessOf(glossiness);
  } else {
    material.baseColor = Vec3f(Vec3d{base[0], base[1], base[2]});
    material.transparency = transparency;
    material.metallic = saturate(pbr["metallicFactor"].real(1));
    material.roughness = saturate(pbr["roughnessFactor"].real(1));
    material.extensions = readMaterialExtensions(extensions);
  }
  material.emissiveColor = Vec3f(value["emissiveFactor"].vec3({0, 0, 0}));
  material.normalScale = static_cast<float>(value["normalTexture"]["scale"].real(1));
  material.occlusionStrength = saturate(value["occlusionTexture"]["strength"].real(1));
  return material;
}

void MaterialReader::readTextures(const Value& value, Appearance& appearance) {
  const Value pbr = value["pbrMetallicRoughness"], extensions = value["extensions"],
              glossiness = extensions["KHR_materials_pbrSpecularGlossiness"];
  const PhysicalMaterial* physical = std::get_if<PhysicalMaterial>(&appearance.material);
  const bool isGlossy = physical && !glossiness.isAbsent();
  addTexture(isGlossy ? glossiness["diffuseTexture"] : pbr["baseColorTexture"], TextureRole::color, appearance);
  if (!physical)
    return;
  addTexture(value["emissiveTexture"], TextureRole::emissive, appearance);
  addTexture(value["normalTexture"], TextureRole::normal, appearance);
  addTexture(value["occlusionTexture"], TextureRole::occlusion, appearance);
  if (isGlossy)
    return readSpecularGlossinessTextures(glossiness, appearance);
  addTexture(pbr["metallicRoughnessTexture"], TextureRole::metallicRoughness, appearance);
  for (const ExtensionTexture& row : extensionTextures())
    addTexture(extensions[row.extension][row.member], row.role, appearance);
}

/// The texture's colours are those of KHR_materials_specular; its alpha, the glossiness, becomes the roughness of a
/// new image.
void MaterialReader::readSpecularGlossinessTextures(const Value& extension, Appearance& appearance) {
  const Value info = extension["specularGlossinessTexture"];
  const std::size_t before = appearance.textures.size();
  addTexture(info, TextureRole::specularColor, appearance);
  if (appearance.textures.size() == before)
    return;
  TextureUse use = appearance.textures.back();
  use.role = TextureRole::metallicRoughness;
  const float glossiness = saturate(extension["glossinessFactor"].real(1));
  const auto [found, isNew] = roughnessTextures_.try_emplace({use.texture, glossiness});
  if (isNew)
    try {
      const ImageFile& image = graph_.images[graph_.textures[use.texture].image];
      Raster raster = decodeRaster(image.bytes, info.location());
      for (std::size_t at = 0; at < raster.pixels.size(); at += 4) {
        const float roughness = 255 - glossiness * static_cast<float>(raster.pixels[at + 3]);
        raster.pixels[at] = raster.pixels[at + 2] = 0;
        raster.pixels[at + 1] = static_cast<std::uint8_t>(std::lround(roughness));
        raster.pixels[at + 3] = 255;
      }
      Texture texture = graph_.textures[use.texture];
      texture.image = graph_.images.size();
      graph_.images.push_back({"", encodeLosslessWebp(raster)});
      graph_.textures.push_back(std::move(texture));
      found->second = graph_.textures.size() - 1;
    } catch (const Error& error) {
      if (isStrict_)
        throw;
      omissions.images.push_back(fmt::format("The glossiness of a texture is left out: {}.", error.what()));
    }
  if (!found->second)
    return;
  use.texture = *found->second;
  appearance.textures.push_back(use);
  std::get<PhysicalMaterial>(appearance.material).roughness = 1;
}

std::size_t MaterialReader::appearance(std::size_t index) {
  if (const auto found = appearances_.find(index); found != appearances_.end())
    return found->second;
  const Value value = document_.array("materials")[index];
  Appearance appearance;
  usedTexCoordSets_.clear();
  appearance.name = value["name"].text();
  appearance.material = materialOf(value);
  readTextures(value, appearance);
  const std::string alphaMode = value["alphaMode"].text("OPAQUE");
  appearance.alphaMode = alphaMode == "BLEND"  ? AlphaMode::blend
                         : alphaMode == "MASK" ? AlphaMode::mask
                                               : AlphaMode::opaque;
  appearance.alphaCutoff = static_cast<float>(value["alphaCutoff"].real(0.5));
  texCoordSets_[index] = usedTexCoordSets_;
  graph_.appearances.push_back(std::move(appearance));
  return appearances_[index] = graph_.appearances.size() - 1;
}

const std::set<std::size_t>& MaterialReader::texCoordSets(std::size_t material) {
  appearance(material);
  return texCoordSets_[material];
}

bool MaterialReader::isSolid(std::size_t material) const {
  return !document_.array("materials")[material]["doubleSided"].boolean(false);
}

} // namespace imgeo::gltf
