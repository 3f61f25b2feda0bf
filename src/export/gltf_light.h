#pragma once
// X3D lights as KHR_lights_punctual.

#include "export/gltf_arrays.h"
#include "scene/scene.h"

#include <optional>

namespace imgeo {

struct GltfLight {
  Json json; ///< an element of KHR_lights_punctual.lights
  Affine3d nodeFromLight;
};

/// The glTF light of a light node; nothing for other nodes and for lights that glTF cannot express. Lights of glTF are
/// global and, unless directional, fall off with the square of the distance.
std::optional<GltfLight> gltfLight(const NodeContent& content);

} // namespace imgeo
