#pragma once
// Turns the meshes of an aiScene into meshes and Shapes.

#include "import/assimp/materials.h"
#include "import/import.h"

#include <assimp/scene.h>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo {

class AssimpMeshes {
public:
  /// `name` of the file, for Errors. Everything must outlive this.
  AssimpMeshes(const std::string& name, const AttributeChoice& choice, bool isFbx, Scene& scene,
               AssimpMaterials& materials)
      : name_(name), choice_(choice), isFbx_(isFbx), scene_(scene), materials_(materials) {}

  /// The nodes of one mesh, which have no parent yet.
  struct Nodes {
    std::vector<std::size_t> shapes;     ///< one for each kind of element; all nodes with the mesh share them
    std::vector<std::size_t> displacers; ///< by morph target; the shapes share them
    bool isSkinned = false;              ///< it has bones, and they are not damaged
  };

  /// Adds the next mesh. The result is valid until the next call. Throws Error{malformed} for corners without a vertex
  /// and positions that are not finite.
  const Nodes& add(const aiMesh& source);

  /// The nodes of the mesh of this index, in the order of add().
  const Nodes& at(std::size_t mesh) const { return nodes_.at(mesh); }

  // Numbers of what is left out or repaired.
  std::size_t damagedSkins = 0, damagedTargets = 0; ///< meshes
  std::size_t unknownWeights = 0;                   ///< morph targets
  std::size_t furtherTexCoords = 0;                 ///< meshes with texture coordinates that no texture uses
  std::size_t furtherColors = 0;                    ///< meshes with more than one set of colours
  std::size_t fans = 0;                             ///< polygons that became fans
  std::size_t unusableNormals = 0;                  ///< vertices

private:
  std::size_t displacerNode(const aiAnimMesh& target);
  /// The sets of texture coordinates that textures use, the first where none uses any, and those that the user named.
  std::vector<unsigned> keptTexCoordSets(const aiMesh& source, std::optional<std::size_t> appearance);
  void addCorners(const aiMesh& source, Mesh& mesh);
  /// Adds the vertices that the corners use, in the order of first use.
  void addVertices(const aiMesh& source, const std::vector<unsigned>& texCoordSets, Mesh& mesh);
  void addVertex(const aiMesh& source, std::uint32_t vertex, const std::vector<unsigned>& texCoordSets, Mesh& mesh);

  const std::string& name_;
  const AttributeChoice& choice_;
  const bool isFbx_;
  Scene& scene_;
  AssimpMaterials& materials_;
  std::vector<Nodes> nodes_; ///< by mesh
};

} // namespace imgeo
