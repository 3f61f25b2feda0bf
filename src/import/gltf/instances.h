#pragma once
// The instances of EXT_mesh_gpu_instancing.

#include "import/gltf/document.h"
#include "scene/transform.h"

#include <optional>
#include <vector>

namespace imgeo::gltf {

/// The transforms of the instances of a node's mesh; empty for a node without the extension. Throws Error{malformed}
/// for attributes of different lengths or with numbers that are not finite.
std::optional<std::vector<Transform>> instanceTransforms(Document& document, const Value& node);

} // namespace imgeo::gltf
