#pragma once
// Shapes whose vertices move: with the joints of a skin, and by displacements with a weight each. X3D has both in HAnim
// (ISO/IEC 19774-1), glTF as skins and morph targets. docs/decisions/skins.md.

#include "base/affine.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace imgeo {

struct Mesh;

/// X3D HAnimHumanoid: the Shapes among its children are skins, whose vertices follow joints. A vertex is the sum over
/// its joints of weight * (joint's transform) * (inverse binding) * (position), in the coordinates of the scene.
struct Humanoid {
  std::vector<std::size_t> joints; ///< indices into SceneGraph::nodes, of Transforms; vertices name positions in it
  /// For each joint the map from the coordinates of the shapes, as they were modelled, to those of the joint.
  std::vector<Affine3d> inverseBindings;
  friend bool operator==(const Humanoid&, const Humanoid&) = default;
};

/// X3D HAnimDisplacer, as the child of a Shape: the n-th one has the weight of the mesh's n-th displacements.
struct Displacer {
  std::string name; ///< the author's name of the target; may be empty
  double weight = 0;
  friend bool operator==(const Displacer&, const Displacer&) = default;
};

/// The largest numbers of joints that move a vertex, in sets of four, and of displacers of a shape.
inline constexpr std::size_t maxJointSets = 2, maxDisplacers = 256;

/// Names of the further vertex attributes (NamedAttribute) that hold, of each vertex: four positions in
/// Humanoid::joints; their weights; the displacement of the position; that of the normal.
std::string jointsName(std::size_t set);
std::string jointWeightsName(std::size_t set);
std::string displacementName(std::size_t displacer);
std::string normalDisplacementName(std::size_t displacer);

/// Whether an attribute has one of these names.
bool isOfDeformation(std::string_view attributeName);

/// The sets of joints and the displacements of a mesh.
std::size_t jointSetCount(const Mesh& mesh);
std::size_t displacementCount(const Mesh& mesh);
inline bool isDeformed(const Mesh& mesh) {
  return jointSetCount(mesh) + displacementCount(mesh) > 0;
}

} // namespace imgeo
