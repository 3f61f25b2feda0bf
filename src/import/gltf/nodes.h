#pragma once
// glTF's scenes, nodes, meshes, cameras and lights -> a graph.

#include "import/gltf/materials.h"
#include "import/gltf/primitive.h"

namespace imgeo::gltf {

struct NodeLosses {
  std::size_t skins = 0, otherScenes = 0;
  std::vector<std::string> damage; ///< one sentence for each primitive or node that is left out
};

class NodeReader {
public:
  NodeReader(Document& document, Scene& scene, PrimitiveReader& primitives, MaterialReader& materials, bool isStrict)
      : document_(document), scene_(scene), primitives_(primitives), materials_(materials), isStrict_(isStrict) {}

  /// Reads the document's scene; where it has none, all nodes that are nobody's
  /// children; where it has no nodes, its meshes.
  void readScene();

  NodeLosses losses;

private:
  /// `scale`: by how much its parent is larger in the scene.
  std::optional<std::size_t> readNode(std::size_t index, std::size_t depth, double scale);
  NodeContent transformOf(const Value& node) const;
  void addInstances(const Value& node, std::size_t mesh, std::vector<std::size_t>& children);
  std::optional<std::size_t> meshNode(std::size_t index, const std::string& nodeName);
  std::optional<std::size_t> shapeNode(const Value& primitive, const std::string& name);
  std::size_t meshOf(const Value& primitive);
  void addCamera(const Value& node, std::vector<std::size_t>& children);
  void addLight(const Value& node, double scale, std::vector<std::size_t>& children);
  /// Reads something that may be left out: a sentence where it is, an Error if strict.
  void addNavigation(const Value& extras);
  template <typename Read> void attempt(const Read& read);

  Document& document_;
  Scene& scene_;
  PrimitiveReader& primitives_;
  MaterialReader& materials_;
  bool isStrict_;
  std::vector<bool> visited_;
  std::map<std::size_t, std::optional<std::size_t>> meshNodes_;
  std::map<std::string, std::size_t> meshes_; ///< by what makes a primitive's geometry
};

} // namespace imgeo::gltf
