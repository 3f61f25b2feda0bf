#pragma once
// What of a scene is wanted together.

#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace imgeo {

/// A number for each node: nodes with the same one are shown together as far as the
/// document says. Each choice of a Switch, and each level of a LOD, has its own: whoever
/// sees one need not fetch the others.
std::vector<std::size_t> loadGroups(const SceneGraph& graph);

} // namespace imgeo
