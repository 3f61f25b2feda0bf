#pragma once
// The animations of a scene as those of a glTF file (glTF 2.0, 3.11).

#include "export/gltf_arrays.h"
#include "scene/scene.h"

#include <map>
#include <set>
#include <vector>

namespace imgeo {

/// The nodes whose transforms glTF animations can set: Transforms that routes take the values of position and
/// orientation interpolators to, which a TimeSensor drives. Those with a scaleOrientation are not among them.
std::set<std::size_t> gltfAnimatedNodes(const SceneGraph& graph);

/// The nodes of the file by those of the scene.
struct GltfNodes {
  const std::map<std::size_t, std::vector<std::size_t>>&transforms, &shapes;
};

/// The animations, one for each TimeSensor. Adds keys to `arrays`.
Json gltfAnimations(const Scene& scene, const GltfNodes& gltfNodes, GltfArrays& arrays);

} // namespace imgeo
