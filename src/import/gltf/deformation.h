#pragma once
// glTF's skins and morph targets (glTF 2.0, 3.7.2.2 and 3.7.3): as further attributes of meshes (scene/skin.h).

#include "import/gltf/primitive.h"
#include "scene/skin.h"

#include <set>
#include <vector>

namespace imgeo::gltf {

/// A skin, with its joints as nodes of the document.
struct Skin {
  std::vector<std::size_t> joints;
  std::vector<Affine3d> inverseBindings; ///< one for each joint
};

/// Reads a skin. Throws Error{malformed} for joints that are no nodes, and for matrices that are too few, not finite or
/// not affine.
Skin readSkin(Document& document, std::size_t index);

/// The nodes that are joints of a skin which some node uses. Skips what readSkin refuses.
std::set<std::size_t> jointNodes(Document& document);

/// Adds JOINTS_n and WEIGHTS_n of the given vertices. Weights that do not sum to one are scaled. Returns how many
/// vertices had such. Throws Error{malformed} for joints that the skin does not have, and weights below 0 or not
/// finite.
std::size_t addJoints(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                      std::size_t jointCount, Mesh& mesh);

/// Adds the displacements of a primitive's morph targets; those of normals if the mesh has normals and any target has
/// some. Throws Error{malformed} for targets with another number of vertices or numbers that are not finite, and
/// Error{unsupported} for more than maxDisplacers.
void addDisplacements(Document& document, const Value& primitive, std::size_t vertexCount,
                      const std::vector<std::uint32_t>& vertices, Mesh& mesh);

/// The displacers of a mesh with `count` targets: their names (extras.targetNames), and the weights of the node or else
/// of the mesh. Throws Error{malformed} for another number of weights.
std::vector<Displacer> displacersOf(const Value& node, const Value& mesh, std::size_t count);

} // namespace imgeo::gltf
