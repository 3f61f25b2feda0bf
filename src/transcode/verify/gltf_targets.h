#pragma once
// The instances of nodes that channels of glTF set, told by what both a site and a glTF file have: their shapes.

#include "scene/gltf_channels.h"
#include "scene/scene.h"

#include <compare>
#include <cstddef>
#include <map>
#include <vector>

namespace imgeo {

/// An instance of a Transform or a Displacer.
struct GltfTarget {
  std::size_t firstShape = 0, endShape = 0; ///< the instances of shapes below it, by their numbers in document order
  std::size_t number = 0;                   ///< among the Transforms with the same shapes, or the displacers of a shape
  auto operator<=>(const GltfTarget&) const = default;
};

struct GltfTargetInstance {
  GltfTarget target;
  Affine3d worldFromParent; ///< while nothing moves
};

struct GltfTargets {
  /// By node. Transforms that have no shapes below them and are no joints of skins have none.
  std::map<std::size_t, std::vector<GltfTargetInstance>> ofNode;
  /// By number of the shape's instance: the displacers of shapes that have some.
  std::map<std::size_t, std::vector<std::size_t>> displacers;
};

/// Throws Error{limit} where USEs make more than four million instances of nodes.
GltfTargets gltfTargetsOf(const SceneGraph& graph, const std::vector<GltfChannel>& channels);

} // namespace imgeo
