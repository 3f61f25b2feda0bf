#pragma once
// Turns glTF's animations into X3D's nodes.

#include "import/animation/animation_builder.h"
#include "import/gltf/document.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace imgeo::gltf {

/// The nodes that any channel of an animation moves: they become Transforms of their own.
std::set<std::size_t> movedNodes(Document& document);

/// The nodes of the scene that animations move, by the node of the document.
struct AnimatedNodes {
  std::map<std::size_t, std::size_t> transforms;
  std::map<std::size_t, std::vector<std::size_t>> displacers; ///< one for each morph target
};

struct AnimationOmissions {
  std::size_t otherPaths = 0;      ///< channels of other properties than a node's transform and weights
  std::vector<std::string> damage; ///< one warning for each channel that is left out
};

class AnimationReader {
public:
  AnimationReader(Document& document, SceneGraph& graph, bool isStrict)
      : document_(document), builder_(graph), isStrict_(isStrict) {}

  /// Adds all animations. Channels of other nodes than `nodes` are no part of the scene. Malformed ones are left out,
  /// or an Error if strict.
  void read(const AnimatedNodes& nodes);

  AnimationOmissions omissions;

private:
  struct Channel {
    std::vector<std::size_t> nodes; ///< of the scene: one Transform, or the displacers of a mesh
    std::size_t sampler = 0;
    AnimatedField field = AnimatedField::translation;
  };

  void readAnimation(const Value& animation, const AnimatedNodes& nodes);
  std::optional<Channel> channelOf(const Value& channel, const Value& samplers, const AnimatedNodes& nodes);
  std::vector<AnimationKeys> keysOf(const Value& sampler, AnimatedField field, std::size_t nodeCount);
  template <typename Read> void attempt(const Read& read);

  Document& document_;
  AnimationBuilder builder_;
  bool isStrict_;
};

} // namespace imgeo::gltf
