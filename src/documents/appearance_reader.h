#pragma once
// Reads Appearance elements into the appearances, textures and images of a scene graph.

#include "documents/field_reader.h"
#include "scene/scene.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace imgeo {

class AppearanceReader {
public:
  AppearanceReader(const DocumentText& source, SceneGraph& graph, DocumentWarnings& warnings)
      : source_(source), graph_(graph), warnings_(warnings) {}

  /// Reads an Appearance, or finds the one that it USEs. Returns its index. Malformed fields have their defaults, with
  /// a warning.
  std::size_t read(const pugi::xml_node& node);

  /// The appearance of triangles that are not lit (`lit="false"`, X3DOM), by that of their Shape: an UnlitMaterial in
  /// the colours of the texture, else those of the vertices, else the material's emissiveColor; white without a
  /// material. Returns its index.
  std::size_t unlit(std::optional<std::size_t> appearance, bool hasVertexColors);

private:
  /// A material with its textures. `mappings` has the values of its mapping fields, by nameOf(TextureRole).
  struct DefinedMaterial {
    AnyMaterial material;
    std::vector<TextureUse> textures;
    std::map<std::string, std::string> mappings;
  };

  FieldReader fieldsOf(const pugi::xml_node& node) const { return {source_, node, &warnings_}; }
  DefinedMaterial readMaterial(const FieldReader& fields);
  /// Reads the textures of `owner`, a material or an extension.
  template <typename Node> void readTextures(const FieldReader& fields, const Node& owner, DefinedMaterial& read);
  void readExtensions(const FieldReader& material, DefinedMaterial& read);
  std::size_t readTexture(const FieldReader& fields);
  void readTransforms(const FieldReader& fields, std::map<std::string, TextureTransform>& transforms) const;
  /// The definition that the element USEs; nullptr if it is not a USE or, with a warning, if the name is unknown.
  template <typename T> const T* definitionOf(const FieldReader& fields, const std::map<std::string, T>& defined) const;

  const DocumentText& source_;
  SceneGraph& graph_;
  DocumentWarnings& warnings_;
  /// Indices by DEF; of images, by url.
  std::map<std::string, std::size_t> appearances_, textures_;
  std::map<std::vector<std::string>, std::size_t> images_; ///< by URLs
  std::map<std::string, DefinedMaterial> materials_;       ///< by DEF
  std::set<std::size_t> withoutMaterial_;                  ///< indices of appearances
  /// Results of unlit(), by its parameters.
  std::map<std::pair<std::optional<std::size_t>, bool>, std::size_t> unlit_;
};

} // namespace imgeo
