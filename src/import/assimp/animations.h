#pragma once
// Turns the animations of an aiScene into X3D's nodes.

#include "import/animation/animation_builder.h"

#include <assimp/scene.h>
#include <map>
#include <string>

namespace imgeo {

class AssimpAnimations {
public:
  /// `nodes`: the moved Transforms by the names of the source's nodes. Everything must outlive this.
  AssimpAnimations(const aiScene& source, SceneGraph& graph, const std::map<std::string, std::size_t>& nodes)
      : source_(source), graph_(graph), nodes_(nodes), builder_(graph) {}

  void read();

  std::size_t otherChannels = 0;     ///< of morph targets
  std::size_t malformedChannels = 0; ///< left out: keys that are not finite, or not in ascending order

private:
  void readAnimation(const aiAnimation& animation);

  const aiScene& source_;
  SceneGraph& graph_;
  const std::map<std::string, std::size_t>& nodes_;
  AnimationBuilder builder_;
};

/// The Transform whose translation, rotation and scale (along its own axes) are those of a map without shear: the
/// fields that animations set.
Transform unskewedTransformOf(const Affine3d& map);

} // namespace imgeo
