#include "import/assimp/repair.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <string>
#include <vector>

namespace imgeo {

namespace {

template <typename Visit> void visitNodes(aiNode* node, Visit visit) {
  if (node == nullptr)
    return;
  visit(*node);
  for (unsigned i = 0; i < node->mNumChildren; ++i)
    visitNodes(node->mChildren[i], visit);
}

/// Files of Blitz 3D state the last frame, and may have a key behind it.
void lengthen(aiAnimation& animation) {
  const auto contain = [&](const auto* keys, unsigned count) {
    for (unsigned i = 0; keys != nullptr && i < count; ++i)
      animation.mDuration = std::max(animation.mDuration, keys[i].mTime);
  };
  for (unsigned i = 0; i < animation.mNumChannels; ++i)
    if (const aiNodeAnim* channel = animation.mChannels[i]) {
      contain(channel->mPositionKeys, channel->mNumPositionKeys);
      contain(channel->mRotationKeys, channel->mNumRotationKeys);
      contain(channel->mScalingKeys, channel->mNumScalingKeys);
    }
}

/// A light has the name of its node. AC3D files may have several nodes of a name.
void nameApart(aiScene& scene) {
  std::map<std::string, std::vector<aiLight*>> lightsByName;
  for (unsigned i = 0; i < scene.mNumLights; ++i)
    if (aiLight* light = scene.mLights[i])
      lightsByName[light->mName.C_Str()].push_back(light);
  for (const auto& entry : lightsByName) {
    const std::vector<aiLight*>& lights = entry.second;
    std::vector<aiNode*> nodes;
    visitNodes(scene.mRootNode, [&](aiNode& node) {
      if (entry.first == node.mName.C_Str())
        nodes.push_back(&node);
    });
    for (std::size_t i = 1; nodes.size() == lights.size() && i < nodes.size(); ++i) {
      nodes[i]->mName.Set(fmt::format("{}-{}", entry.first, i + 1));
      lights[i]->mName = nodes[i]->mName;
    }
  }
}

} // namespace

void repair(aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumAnimations; ++i)
    if (scene.mAnimations[i] != nullptr)
      lengthen(*scene.mAnimations[i]);
  nameApart(scene);
}

} // namespace imgeo
