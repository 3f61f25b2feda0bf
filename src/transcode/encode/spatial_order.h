#pragma once
// An order of shapes in which those that come one after the other stand near each other.

#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace imgeo {

/// The Shape nodes in Morton order of the middles of their boxes in the world; a node that
/// stands in several places counts at its first. `boxes` are by the shapes' meshes.
std::vector<std::size_t> spatialOrder(const SceneGraph& graph, const std::vector<Box3d>& boxes);

} // namespace imgeo
