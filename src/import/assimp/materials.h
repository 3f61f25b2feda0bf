#pragma once
// Turns Assimp's materials and textures into appearances.

#include "import/references.h"
#include "import/source_images.h"
#include "scene/scene.h"

#include <assimp/scene.h>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

class AssimpMaterials {
public:
  /// `extension` of the source's name: in lower case, without its dot.
  AssimpMaterials(const aiScene& source, SceneGraph& graph, const References& references, std::string_view extension);

  /// Index of the appearance of a material, which is read at the first call. Empty for the default material that Assimp
  /// adds to sources without materials.
  std::optional<std::size_t> appearance(unsigned material);
  bool isSolid(unsigned material) const;

  /// One warning for each image that is left out.
  const std::vector<std::string>& omissions() const { return images_.omissions; }
  void addWarnings(std::vector<std::string>& warnings) const;

private:
  AnyMaterial materialOf(const aiMaterial& material) const;
  /// 0 … 1
  float transparencyOf(const aiMaterial& material) const;
  void addTexture(const aiMaterial& material, aiTextureType type, TextureRole role, Appearance& appearance);
  std::optional<std::size_t> image(const std::string& path);
  Bytes bytesOf(const std::string& path) const;

  const aiScene& source_;
  SceneGraph& graph_;
  const References& references_;
  SourceImages images_;
  const bool invertsTransparency_;    ///< COLLADA whose writer counts transparency from 0, opaque, upwards
  const bool colorTextureIsEmissive_; ///< the colour texture also modulates the emissive colour
  std::map<unsigned, std::optional<std::size_t>> appearances_;
  std::map<std::string, std::size_t> others_; ///< textures of other kinds, by kind
};

} // namespace imgeo
