#pragma once
// Groups of shapes that are loaded together.

#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace imgeo {

/// The group number of each node. Nodes of one group are visible together. Each choice of a Switch and each level of a
/// LOD is a group of its own, so that the visible one loads without the others.
std::vector<std::size_t> loadGroups(const SceneGraph& graph);

} // namespace imgeo
