#pragma once
// glTF's materials, textures and images -> appearances.

#include "import/gltf/document.h"
#include "scene/scene.h"

#include <map>
#include <set>
#include <string>

namespace imgeo::gltf {

struct MaterialLosses {
  std::map<std::string, std::size_t> extensions; ///< by name: materials whose extension was left out
  std::size_t secondTexCoords = 0;               ///< textures that use coordinates beyond the first
  std::size_t skewedTransforms = 0;              ///< texture transforms that X3D's cannot say
  std::vector<std::string> images;               ///< one sentence for each image that is missing
};

class MaterialReader {
public:
  MaterialReader(Document& document, SceneGraph& graph, bool isStrict)
      : document_(document), graph_(graph), isStrict_(isStrict) {}

  /// The appearance of a material; read when it is first asked for.
  std::size_t appearance(std::size_t material);

  /// Whether a material is seen from one side alone.
  bool isSolid(std::size_t material) const;

  MaterialLosses losses;

private:
  AnyMaterial materialOf(const Value& value);
  void readTextures(const Value& value, Appearance& appearance);
  void addTexture(const Value& info, TextureRole role, Appearance& appearance);
  std::optional<std::size_t> texture(std::size_t index);
  std::optional<std::size_t> image(std::size_t index);
  TextureTransform transformOf(const Value& extension);

  Document& document_;
  SceneGraph& graph_;
  bool isStrict_;
  std::map<std::size_t, std::size_t> appearances_;
  std::map<std::size_t, std::optional<std::size_t>> textures_, images_;
};

/// X3D's form of an affine map of texture coordinates that are measured up:
/// (a c; b d) and (x, y); nothing where it has none.
std::optional<TextureTransform> textureTransformOf(double a, double b, double c, double d, double x, double y);

} // namespace imgeo::gltf
