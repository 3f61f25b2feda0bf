#pragma once
// Turns the animations of an aiScene into X3D's nodes.

#include "import/animation/animation_builder.h"

#include <assimp/scene.h>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace imgeo {

/// The displacers of meshes with morph targets, in the order of the targets, by the names of the nodes and of the
/// meshes to which an animation may refer.
using DisplacersByName = std::map<std::string, std::set<std::vector<std::size_t>>>;

class AssimpAnimations {
public:
  /// `nodes`: the moved Transforms by the names of the source's nodes. Everything must outlive this.
  AssimpAnimations(const aiScene& source, SceneGraph& graph, const std::map<std::string, std::size_t>& nodes,
                   const DisplacersByName& displacers)
      : source_(source), graph_(graph), nodes_(nodes), displacers_(displacers), builder_(graph) {}

  void read();

  std::size_t otherChannels = 0;     ///< left out: of whole meshes, and of morph targets that no mesh has
  std::size_t malformedChannels = 0; ///< left out: keys that are not finite, or not in ascending order

private:
  void readAnimation(const aiAnimation& animation);
  void readNode(const aiNodeAnim& channel, double ticksPerSecond);
  void readWeights(const aiMeshMorphAnim& channel, double ticksPerSecond);

  const aiScene& source_;
  SceneGraph& graph_;
  const std::map<std::string, std::size_t>& nodes_;
  const DisplacersByName& displacers_;
  AnimationBuilder builder_;
};

/// The Transform whose translation, rotation and scale (along its own axes) are those of a map without shear: the
/// fields that animations set.
Transform unskewedTransformOf(const Affine3d& map);

} // namespace imgeo
