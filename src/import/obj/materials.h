#pragma once
// MTL files (Wavefront Technologies, Advanced Visualizer manual, appendix B4; Ben Houston, "Extending Wavefront MTL for
// Physically-Based Rendering", 2015).

#include "import/references.h"
#include "import/source_images.h"
#include "scene/scene.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

class TextScanner;

class ObjMaterials {
public:
  ObjMaterials(SceneGraph& graph, const References& references)
      : graph_(graph), references_(references), images_(graph) {}

  /// Reads the file or files that an mtllib statement names. Files that cannot be read become warnings.
  void readLibrary(const std::string& files);

  /// Index of the appearance of a material; empty where no library defines the material.
  std::optional<std::size_t> appearance(const std::string& name);

  /// One warning for each file that is left out, and one for the materials that no library defines.
  std::vector<std::string> omissions() const;
  void addWarnings(std::vector<std::string>& warnings) const;

private:
  struct TextureMap {
    TextureRole role = TextureRole::color;
    std::string file;   ///< as the library names it
    std::string folder; ///< of the library, relative to that of the OBJ file: empty, or with a slash at the end
    TextureTransform transform;
    bool clamps = false;
    friend bool operator==(const TextureMap&, const TextureMap&) = default;
  };
  struct Definition {
    Material material;
    std::optional<float> metallic, roughness; ///< present in physically based materials
    std::vector<TextureMap> maps;
  };

  void readFile(const std::string& file);
  void readStatement(TextScanner& scanner, Definition& definition, const std::string& folder);
  static TextureMap readMap(TextScanner& scanner, TextureRole role);
  std::string urlOf(const TextureMap& map) const;
  Appearance appearanceOf(const std::string& name, const Definition& definition);
  std::optional<std::size_t> image(const TextureMap& map);

  SceneGraph& graph_;
  const References& references_;
  std::map<std::string, Definition> definitions_;
  std::map<std::string, std::optional<std::size_t>> appearances_;
  SourceImages images_;
  std::vector<std::string> missingLibraries_;
  std::set<std::string> undefined_, skippedKeywords_; ///< names of materials; keywords of statements
};

} // namespace imgeo
