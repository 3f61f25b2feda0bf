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

struct AnimationOmissions {
  std::size_t otherPaths = 0;      ///< channels of other properties than a node's transform
  std::vector<std::string> damage; ///< one warning for each channel that is left out
};

class AnimationReader {
public:
  AnimationReader(Document& document, SceneGraph& graph, bool isStrict)
      : document_(document), builder_(graph), isStrict_(isStrict) {}

  /// Adds all animations. `nodes`: the node of the scene for a node of the document. Channels of other nodes are no
  /// part of the scene. Malformed ones are left out, or an Error if strict.
  void read(const std::map<std::size_t, std::size_t>& nodes);

  AnimationOmissions omissions;

private:
  struct Channel {
    std::size_t node = 0, sampler = 0;
    AnimatedField field = AnimatedField::translation;
  };

  void readAnimation(const Value& animation, const std::map<std::size_t, std::size_t>& nodes);
  std::optional<Channel> channelOf(const Value& channel, const Value& samplers,
                                   const std::map<std::size_t, std::size_t>& nodes);
  AnimationKeys keysOf(const Value& sampler, AnimatedField field);
  template <typename Read> void attempt(const Read& read);

  Document& document_;
  AnimationBuilder builder_;
  bool isStrict_;
};

} // namespace imgeo::gltf
