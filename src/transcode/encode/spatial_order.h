#pragma once
// An order of shapes in which neighbours are near each other in the world.

#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace imgeo {

/// The Shape nodes in Morton order of the centres of their boxes in world coordinates. Of a USEd node the first
/// instance counts. `boxes` has the box of each mesh.
std::vector<std::size_t> spatialOrder(const SceneGraph& graph, const std::vector<Box3d>& boxes);

} // namespace imgeo
