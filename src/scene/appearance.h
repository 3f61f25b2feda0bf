#pragma once
// Appearances: X3D 4's materials, and textures with their samplers. Plain data with X3D's defaults.

#include "base/bytes.h"
#include "base/vec.h"
#include "scene/material_extensions.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace imgeo {

/// X3D Material: colours 0..1; shininess 0..1, which times 128 is the specular exponent.
struct Material {
  Vec3f diffuseColor{0.8f, 0.8f, 0.8f};
  Vec3f specularColor{0, 0, 0};
  Vec3f emissiveColor{0, 0, 0};
  float ambientIntensity = 0.2f;
  float shininess = 0.2f;
  float transparency = 0;
  friend bool operator==(const Material&, const Material&) = default;
};

/// X3D 4 PhysicalMaterial: glTF 2.0's metallic-roughness material, with linear colours as in glTF.
struct PhysicalMaterial {
  Vec3f baseColor{1, 1, 1};
  Vec3f emissiveColor{0, 0, 0};
  float metallic = 1;
  float roughness = 1;
  float transparency = 0;
  float normalScale = 1;
  float occlusionStrength = 1;
  std::vector<MaterialExtension> extensions{}; ///< at most one of each kind, in the order of the variant
  friend bool operator==(const PhysicalMaterial&, const PhysicalMaterial&) = default;
};

/// X3D 4 UnlitMaterial.
struct UnlitMaterial {
  Vec3f emissiveColor{1, 1, 1};
  float transparency = 0;
  friend bool operator==(const UnlitMaterial&, const UnlitMaterial&) = default;
};

using AnyMaterial = std::variant<Material, PhysicalMaterial, UnlitMaterial>;

/// Approximates any material by an X3D Material (Phong), for renderers without the other kinds.
Material phongOf(const AnyMaterial& material);

/// The property of a material that a texture modulates. `color` is the texture of diffuseColor, baseColor or an
/// UnlitMaterial's emissiveColor.
enum class TextureRole : std::uint8_t {
  color,
  emissive,
  metallicRoughness, ///< PhysicalMaterial only
  normal,
  occlusion,
  ambient,   ///< Material only
  specular,  ///< Material only
  shininess, ///< Material only
  // The extensions of PhysicalMaterial; the channels are those of glTF.
  anisotropy,
  clearcoat,
  clearcoatRoughness,
  clearcoatNormal,
  iridescence,
  iridescenceThickness,
  sheenColor,
  sheenRoughness,
  specularStrength,
  specularColor,
  transmission,
  thickness,
};

inline constexpr std::size_t textureRoleCount = static_cast<std::size_t>(TextureRole::thickness) + 1;

/// The extension of a material; null where it has none of this kind.
template <typename Extension> const Extension* extensionOf(const PhysicalMaterial& material) {
  for (const MaterialExtension& extension : material.extensions)
    if (const Extension* found = std::get_if<Extension>(&extension))
      return found;
  return nullptr;
}

/// X3D TextureTransform: a texture coordinate t is read at
/// -center + scale * rotation * (t + translation + center).
struct TextureTransform {
  Vec2f translation{0, 0}, scale{1, 1}, center{0, 0};
  float rotation = 0; ///< radians
  friend bool operator==(const TextureTransform&, const TextureTransform&) = default;
};

enum class Boundary : std::uint8_t { repeat, clamp, mirroredRepeat };
/// `standard`: the source does not state a filter.
enum class Filter : std::uint8_t { standard, nearest, linear };

/// X3D ImageTexture with its TextureProperties.
struct Texture {
  std::string name;      ///< name in the source; may be empty
  std::size_t image = 0; ///< index into SceneGraph::images
  Boundary boundaryS = Boundary::repeat, boundaryT = Boundary::repeat;
  Filter magnification = Filter::standard, minification = Filter::standard;
  Filter betweenMipMaps = Filter::standard; ///< between mip levels: nearest or linear; used if `mipMaps`
  bool mipMaps = true;
  friend bool operator==(const Texture&, const Texture&) = default;
};

/// An image file.
struct ImageFile {
  std::string url;       ///< in a document: relative to it; in a source: the source's name for the image
  Bytes bytes{};         ///< the file's content; empty in a document that was read
  std::string preview{}; ///< url of a small version of the image, displayed until the image has loaded; may be empty
  std::vector<std::string> furtherUrls{}; ///< in a document: tried in order where `url` names no file
  friend bool operator==(const ImageFile&, const ImageFile&) = default;
};

/// A texture in a role of an appearance.
struct TextureUse {
  TextureRole role = TextureRole::color;
  std::size_t texture = 0; ///< index into SceneGraph::textures
  TextureTransform transform;
  std::string mapping{}; ///< the name of the set of texture coordinates that it uses; see texCoordSetNamed
  friend bool operator==(const TextureUse&, const TextureUse&) = default;
};

enum class AlphaMode : std::uint8_t { automatic, opaque, mask, blend };

/// X3D Appearance.
struct Appearance {
  std::string name; ///< name of the source's material; may be empty
  AnyMaterial material;
  std::vector<TextureUse> textures; ///< at most one for each role
  AlphaMode alphaMode = AlphaMode::automatic;
  float alphaCutoff = 0.5f; ///< for AlphaMode::mask
  friend bool operator==(const Appearance&, const Appearance&) = default;
};

} // namespace imgeo
