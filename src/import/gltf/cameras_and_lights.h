#pragma once
// glTF's cameras and lights as nodes of X3D.

#include "import/gltf/damage.h"
#include "import/gltf/document.h"
#include "scene/scene.h"

#include <optional>

namespace imgeo::gltf {

/// The viewpoint of a node's camera; empty without one.
std::optional<Node> cameraOf(const Document& document, const Value& node);

/// The light of a node, by KHR_lights_punctual: photometric units, falling off with the square of the distance. Range
/// and falloff are measured in scene units in glTF, in the node's coordinate system in X3D. `scale`: that of the node
/// relative to the scene. Empty without a light, and with a warning for one that X3D does not have.
std::optional<Node> lightOf(const Document& document, const Value& node, double scale, Damage& damage);

} // namespace imgeo::gltf
