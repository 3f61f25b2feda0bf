#pragma once
// What of a scene's animation glTF can express (glTF 2.0, 3.11): a TimeSensor that drives an interpolator, which sets
// the translation, rotation or scale of a Transform, or the weight of a Displacer.

#include "scene/scene.h"

#include <cstdint>
#include <vector>

namespace imgeo {

/// What a channel of glTF sets.
enum class GltfPath : std::uint8_t { translation, rotation, scale, weights };

/// The routes that are a channel of glTF. They point into the scene's.
struct GltfChannel {
  const Route* clock = nullptr; ///< from a TimeSensor to an interpolator
  const Route* value = nullptr; ///< from that to a Transform, or to a Displacer for GltfPath::weights
  GltfPath path = GltfPath::translation;
};

/// All channels, in the order of the routes from TimeSensors. Interpolators of them are well formed and have keys; a
/// Transform with a scaleOrientation has none.
std::vector<GltfChannel> gltfChannelsOf(const SceneGraph& graph);

} // namespace imgeo
