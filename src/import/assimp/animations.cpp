#include "import/assimp/animations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

namespace imgeo {

namespace {

constexpr double defaultTicksPerSecond = 25; // Assimp's convention where a file states none

/// The keys of a channel; empty where they are malformed. `numbersOf` gives the numbers of a key's value.
template <typename Key, typename NumbersOf>
std::optional<AnimationKeys> keysOf(const Key* keys, unsigned count, double ticksPerSecond,
                                    const NumbersOf& numbersOf) {
  AnimationKeys read;
  for (unsigned i = 0; i < count; ++i) {
    const auto seconds = static_cast<float>(std::max(0.0, keys[i].mTime / ticksPerSecond));
    if (!std::isfinite(seconds) || (i > 0 && seconds < read.seconds.back()))
      return std::nullopt;
    read.seconds.push_back(seconds);
    const auto numbers = numbersOf(keys[i].mValue);
    read.components = numbers.size();
    for (const float number : numbers) {
      if (!std::isfinite(number))
        return std::nullopt;
      read.values.push_back(number);
    }
  }
  return read;
}

/// The weights of a morph target, which are 0 at keys that do not name it; empty where they are malformed.
std::optional<AnimationKeys> weightsOf(const aiMeshMorphAnim& channel, unsigned target, double ticksPerSecond) {
  AnimationKeys read;
  read.components = 1;
  for (unsigned i = 0; i < channel.mNumKeys; ++i) {
    const aiMeshMorphKey& key = channel.mKeys[i];
    const auto seconds = static_cast<float>(std::max(0.0, key.mTime / ticksPerSecond));
    float weight = 0;
    for (unsigned value = 0; value < key.mNumValuesAndWeights; ++value)
      if (key.mValues[value] == target)
        weight = static_cast<float>(key.mWeights[value]);
    if (!std::isfinite(seconds) || !std::isfinite(weight) || (i > 0 && seconds < read.seconds.back()))
      return std::nullopt;
    read.seconds.push_back(seconds);
    read.values.push_back(weight);
  }
  return read;
}

/// Whether all values are those of the first key, and `rest`: the source has such keys where nothing moves.
bool isAtRest(const AnimationKeys& keys, std::span<const double> rest) {
  constexpr double slack = 1e-6;
  for (std::size_t i = 0; i < keys.values.size(); ++i) {
    const double at = rest[i % keys.components];
    if (std::abs(keys.values[i] - at) > slack * std::max(1.0, std::abs(at)))
      return false;
  }
  return true;
}

double lastTicksOf(const aiNodeAnim& channel) {
  double last = 0;
  if (channel.mNumPositionKeys > 0)
    last = std::max(last, channel.mPositionKeys[channel.mNumPositionKeys - 1].mTime);
  if (channel.mNumRotationKeys > 0)
    last = std::max(last, channel.mRotationKeys[channel.mNumRotationKeys - 1].mTime);
  if (channel.mNumScalingKeys > 0)
    last = std::max(last, channel.mScalingKeys[channel.mNumScalingKeys - 1].mTime);
  return last;
}

} // namespace

Transform unskewedTransformOf(const Affine3d& map) {
  Vec3d scale{length(map.x), length(map.y), length(map.z)};
  if (!(scale.x > 0 && scale.y > 0 && scale.z > 0))
    return transformOf(map);
  if (map.determinant() < 0)
    scale.x = -scale.x;
  Transform transform;
  transform.translation = map.translation;
  transform.rotation = transformOf({map.x * (1 / scale.x), map.y * (1 / scale.y), map.z * (1 / scale.z), {}}).rotation;
  transform.scale = scale;
  return transform;
}

void AssimpAnimations::read() {
  for (unsigned i = 0; i < source_.mNumAnimations; ++i)
    readAnimation(*source_.mAnimations[i]);
}

void AssimpAnimations::readAnimation(const aiAnimation& animation) {
  const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : defaultTicksPerSecond;
  otherChannels += animation.mNumMeshChannels;
  double last = 0;
  for (unsigned c = 0; c < animation.mNumChannels; ++c)
    last = std::max(last, lastTicksOf(*animation.mChannels[c]));
  for (unsigned c = 0; c < animation.mNumMorphMeshChannels; ++c)
    if (const aiMeshMorphAnim& channel = *animation.mMorphMeshChannels[c]; channel.mNumKeys > 0)
      last = std::max(last, channel.mKeys[channel.mNumKeys - 1].mTime);
  if (!std::isfinite(last / ticks)) {
    ++malformedChannels;
    return;
  }
  builder_.begin(animation.mName.C_Str(), last / ticks);
  for (unsigned c = 0; c < animation.mNumChannels; ++c)
    readNode(*animation.mChannels[c], ticks);
  for (unsigned c = 0; c < animation.mNumMorphMeshChannels; ++c)
    readWeights(*animation.mMorphMeshChannels[c], ticks);
}

void AssimpAnimations::readNode(const aiNodeAnim& channel, double ticksPerSecond) {
  const auto found = nodes_.find(channel.mNodeName.C_Str());
  if (found == nodes_.end())
    return;
  const std::size_t node = found->second;
  const Transform rest = std::get<Transform>(graph_.nodes[node].content);
  const auto vectorOf = [](const aiVector3D& v) { return std::vector<float>{v.x, v.y, v.z}; };
  const auto quaternionNumbers = [](const aiQuaternion& q) { return std::vector<float>{q.x, q.y, q.z, q.w}; };
  const auto animate = [&](AnimatedField field, const std::optional<AnimationKeys>& keys,
                           std::span<const double> atRest) {
    malformedChannels += !keys;
    if (keys && !keys->seconds.empty() && !isAtRest(*keys, atRest))
      builder_.animate(node, field, *keys, nullptr);
  };
  const Vec3d &t = rest.translation, &s = rest.scale;
  animate(AnimatedField::translation, keysOf(channel.mPositionKeys, channel.mNumPositionKeys, ticksPerSecond, vectorOf),
          std::array{t.x, t.y, t.z});
  animate(AnimatedField::rotation,
          keysOf(channel.mRotationKeys, channel.mNumRotationKeys, ticksPerSecond, quaternionNumbers),
          quaternionOf(rest.rotation));
  animate(AnimatedField::scale, keysOf(channel.mScalingKeys, channel.mNumScalingKeys, ticksPerSecond, vectorOf),
          std::array{s.x, s.y, s.z});
}

void AssimpAnimations::readWeights(const aiMeshMorphAnim& channel, double ticksPerSecond) {
  // FBX: "NODE*0", with the number of a geometry.
  const std::string name = channel.mName.C_Str();
  auto found = displacers_.find(name);
  if (found == displacers_.end())
    found = displacers_.find(name.substr(0, name.rfind('*')));
  if (found == displacers_.end()) {
    ++otherChannels;
    return;
  }
  for (const std::vector<std::size_t>& displacers : found->second)
    for (unsigned target = 0; target < displacers.size(); ++target) {
      const std::optional<AnimationKeys> keys = weightsOf(channel, target, ticksPerSecond);
      const double rest = std::get<Displacer>(graph_.nodes[displacers[target]].content).weight;
      malformedChannels += !keys;
      if (keys && !keys->seconds.empty() && !isAtRest(*keys, std::array{rest}))
        builder_.animate(displacers[target], AnimatedField::weights, *keys, nullptr);
    }
}

} // namespace imgeo
