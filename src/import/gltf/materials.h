#pragma once
// Turns glTF's materials, textures and images into appearances.

#include "import/gltf/document.h"
#include "import/gltf/material_extensions.h"
#include "scene/scene.h"

#include <map>
#include <set>
#include <string>

namespace imgeo::gltf {

struct MaterialOmissions {
  std::size_t skewedTransforms = 0; ///< texture transforms that X3D cannot express
  std::vector<std::string> images;  ///< one warning for each missing image
};

class MaterialReader {
public:
  MaterialReader(Document& document, SceneGraph& graph, bool isStrict)
      : document_(document), graph_(graph), isStrict_(isStrict) {}

  /// Index of the appearance of a material, which is read at the first call.
  std::size_t appearance(std::size_t material);

  /// The sets of texture coordinates that the textures of a material use.
  const std::set<std::size_t>& texCoordSets(std::size_t material);

  /// Whether a material is visible from the front side only.
  bool isSolid(std::size_t material) const;

  MaterialOmissions omissions;

private:
  AnyMaterial materialOf(const Value& value);
  void readTextures(const Value& value, Appearance& appearance);
  void addTexture(const Value& info, TextureRole role, Appearance& appearance);
  std::optional<std::size_t> texture(std::size_t index);
  std::optional<std::size_t> image(std::size_t index);
  /// The textures of KHR_materials_pbrSpecularGlossiness, for a material of `specularGlossinessOf`.
  void readSpecularGlossinessTextures(const Value& extension, Appearance& appearance);
  TextureTransform transformOf(const Value& extension);

  Document& document_;
  SceneGraph& graph_;
  bool isStrict_;
  std::map<std::size_t, std::size_t> appearances_;
  std::map<std::size_t, std::set<std::size_t>> texCoordSets_; ///< by material
  std::set<std::size_t> usedTexCoordSets_;                    ///< those of the material that is being read
  std::map<std::size_t, std::optional<std::size_t>> textures_, images_;
  /// The textures of roughness that were made, by the graph's texture and its factor of glossiness.
  std::map<std::pair<std::size_t, float>, std::optional<std::size_t>> roughnessTextures_;
};

/// The X3D texture transform of an affine map of texture coordinates, with v upwards: matrix (a c; b d) and translation
/// (x, y). Empty for a map that shears or maps an axis to zero.
std::optional<TextureTransform> textureTransformOf(double a, double b, double c, double d, double x, double y);

} // namespace imgeo::gltf
