#pragma once
// The shapes of glTF's meshes: a mesh and an appearance for each primitive, variants of materials, morph targets.

#include "import/gltf/damage.h"
#include "import/gltf/materials.h"
#include "import/gltf/primitive.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::gltf {

class ShapeReader {
public:
  ShapeReader(Document& document, Scene& scene, PrimitiveReader& primitives, MaterialReader& materials, Damage& damage)
      : document_(document), scene_(scene), primitives_(primitives), materials_(materials), damage_(damage) {}

  /// The node of a mesh; one for all nodes that refer to it, unless joints or weights of the node `user` move it.
  /// `jointCount`: of the node's skin; 0 without one. Empty where nothing of the mesh can be read.
  std::optional<std::size_t> meshNode(std::size_t index, std::optional<std::size_t> user, std::size_t jointCount);

  /// The displacers of nodes of the document whose meshes have morph targets.
  const std::map<std::size_t, std::vector<std::size_t>>& displacers() const { return displacers_; }

private:
  std::optional<std::size_t> newMeshNode(std::size_t index, std::optional<std::size_t> user, std::size_t jointCount);
  std::size_t targetCountOf(std::size_t mesh) const;
  std::vector<std::size_t> displacerNodes(std::size_t mesh, std::optional<std::size_t> user);
  std::size_t shapeNode(const Value& primitive, const std::string& name, std::size_t jointCount,
                        const std::vector<std::size_t>& displacers);
  std::set<std::size_t> texCoordSetsOf(std::optional<std::size_t> material, const Value& mappings);
  /// The shape with the material; without one, and with a warning, where the material is damaged.
  Shape withMaterial(Shape shape, std::optional<std::size_t> material);
  std::size_t variantsNode(const Shape& shape, std::optional<std::size_t> material, const Value& mappings,
                           const std::string& name, const std::vector<std::size_t>& displacers);
  std::size_t meshOf(const Value& primitive, const std::set<std::size_t>& texCoordSets, std::size_t jointCount);

  Document& document_;
  Scene& scene_;
  PrimitiveReader& primitives_;
  MaterialReader& materials_;
  Damage& damage_;
  std::map<std::size_t, std::optional<std::size_t>> meshNodes_;
  std::map<std::string, std::size_t> meshes_; ///< mesh index by a primitive's JSON without material and extras
  std::map<std::size_t, std::vector<std::size_t>> displacers_;
};

} // namespace imgeo::gltf
