#pragma once
// How deeply nodes may be nested: what visits the graph recurses.

#include "scene/scene.h"

#include <cstddef>
#include <string>

namespace imgeo {

/// Nodes on a path from a root to a node, USEs included.
inline constexpr std::size_t maxNestedNodes = 250;

/// Throws Error{limit} with `location` where USEs nest nodes more deeply.
void checkNestingLimit(const SceneGraph& graph, const std::string& location);

} // namespace imgeo
