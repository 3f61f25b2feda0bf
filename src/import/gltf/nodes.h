#pragma once
// Turns glTF's scenes, nodes, meshes, cameras and lights into a scene graph.

#include "import/gltf/animations.h"
#include "import/gltf/deformation.h"
#include "import/gltf/materials.h"
#include "import/gltf/primitive.h"

namespace imgeo::gltf {

struct NodeOmissions {
  std::size_t otherScenes = 0;
  std::vector<std::string> damage; ///< one warning for each primitive or node that is left out
};

class NodeReader {
public:
  NodeReader(Document& document, Scene& scene, PrimitiveReader& primitives, MaterialReader& materials, bool isStrict)
      : document_(document), scene_(scene), primitives_(primitives), materials_(materials), isStrict_(isStrict),
        moved_(movedNodes(document)), joints_(jointNodes(document)) {}

  /// Reads the document's scene; without scenes, all nodes that are no node's child; without nodes, all meshes.
  void readScene();

  /// The nodes of the scene that animations of the document's nodes move.
  const AnimatedNodes& animatedNodes() const { return animatedNodes_; }

  /// Whether the scene has a shape.
  bool hasShapes() const { return !scene_.meshes.empty(); }

  NodeOmissions omissions;
  std::optional<Error> firstDamage; ///< the error of the first part that is left out

private:
  /// `scale`: the scale of the parent's coordinate system relative to the scene.
  std::optional<std::size_t> readNode(std::size_t index, std::size_t depth, double scale);
  NodeContent contentOf(const Value& node) const;
  void addInstances(const Value& node, std::size_t shape, std::vector<std::size_t>& children);
  /// The node of a mesh; one for all nodes that refer to it, unless joints or weights of the node `user` move it.
  /// `jointCount`: of the node's skin; 0 without one.
  std::optional<std::size_t> meshNode(std::size_t index, std::optional<std::size_t> user, std::size_t jointCount);
  std::optional<std::size_t> newMeshNode(std::size_t index, std::optional<std::size_t> user, std::size_t jointCount);
  std::size_t shapeNode(const Value& primitive, const std::string& name, std::size_t jointCount,
                        const std::vector<std::size_t>& displacers);
  std::size_t targetCountOf(std::size_t mesh) const;
  std::vector<std::size_t> displacerNodes(std::size_t mesh, std::optional<std::size_t> user);
  bool addSkinned(std::size_t node, std::size_t mesh, std::size_t skin);
  void addHumanoids();
  /// The shape with the material; without one, and with a warning, where the material is damaged.
  Shape withMaterial(Shape shape, std::optional<std::size_t> material);
  std::size_t variantsNode(const Shape& shape, std::optional<std::size_t> material, const Value& mappings,
                           const std::string& name, const std::vector<std::size_t>& displacers);
  void addVariantNames();
  std::set<std::size_t> texCoordSetsOf(std::optional<std::size_t> material, const Value& mappings);
  std::size_t meshOf(const Value& primitive, const std::set<std::size_t>& texCoordSets, std::size_t jointCount);
  void addCamera(const Value& node, std::vector<std::size_t>& children);
  void addLight(const Value& node, double scale, std::vector<std::size_t>& children);
  void addNavigation(const Value& extras);
  /// Calls `read` and turns its Error into a warning. If strict, and for Error{limit}, rethrows it.
  template <typename Read> void attempt(const Read& read);

  Document& document_;
  Scene& scene_;
  PrimitiveReader& primitives_;
  MaterialReader& materials_;
  bool isStrict_;
  std::set<std::size_t> moved_;  ///< nodes of the document that an animation moves
  std::set<std::size_t> joints_; ///< nodes of the document that are joints of skins
  AnimatedNodes animatedNodes_;
  struct SkinnedShape {
    std::size_t node = 0, skin = 0; ///< of the document
    std::size_t shape = 0;          ///< of the scene
  };
  std::vector<SkinnedShape> skinned_;
  std::vector<bool> visited_;
  std::map<std::size_t, std::optional<std::size_t>> meshNodes_;
  std::map<std::string, std::size_t> meshes_; ///< mesh index by a primitive's JSON without material and extras
};

} // namespace imgeo::gltf
