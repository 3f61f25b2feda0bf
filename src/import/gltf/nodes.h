#pragma once
// Turns glTF's scenes and nodes, with what they refer to, into a scene graph.

#include "import/gltf/animations.h"
#include "import/gltf/damage.h"
#include "import/gltf/deformation.h"
#include "import/gltf/shapes.h"

#include <set>
#include <vector>

namespace imgeo::gltf {

class NodeReader {
public:
  NodeReader(Document& document, Scene& scene, PrimitiveReader& primitives, MaterialReader& materials, bool isStrict)
      : damage(isStrict), document_(document), scene_(scene), shapes_(document, scene, primitives, materials, damage),
        moved_(movedNodes(document)), joints_(jointNodes(document)) {}

  NodeReader(const NodeReader&) = delete;
  NodeReader& operator=(const NodeReader&) = delete;

  /// Reads the document's scene; without scenes, all nodes that are no node's child; without nodes, all meshes.
  void readScene();

  /// The nodes of the scene that animations of the document's nodes move.
  const AnimatedNodes& animatedNodes() const { return animatedNodes_; }

  /// Whether the scene has a shape.
  bool hasShapes() const { return !scene_.meshes.empty(); }

  std::size_t otherScenes = 0; ///< which are not read
  Damage damage;               ///< primitives and nodes that are left out

private:
  struct SkinnedShape {
    std::size_t node = 0, skin = 0; ///< of the document
    std::size_t shape = 0;          ///< of the scene
  };

  /// `scale`: the scale of the parent's coordinate system relative to the scene.
  std::optional<std::size_t> readNode(std::size_t index, std::size_t depth, double scale);
  NodeContent contentOf(const Value& node) const;
  void addShapes(const Value& node, std::size_t shape, std::vector<std::size_t>& children);
  bool addSkinned(std::size_t node, std::size_t mesh, std::size_t skin);
  void addHumanoid(const SkinnedShape& skinned);
  void addVariantNames();
  void addNavigation(const Value& extras);

  Document& document_;
  Scene& scene_;
  ShapeReader shapes_;
  std::set<std::size_t> moved_;  ///< nodes of the document that an animation moves
  std::set<std::size_t> joints_; ///< nodes of the document that are joints of skins
  AnimatedNodes animatedNodes_;
  std::vector<SkinnedShape> skinned_;
  std::vector<bool> visited_;
};

} // namespace imgeo::gltf
