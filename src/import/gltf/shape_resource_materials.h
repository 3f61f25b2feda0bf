#pragma once
// Reads the materials of a Shape Resource Container.

#include "import/gltf/shape_resource.h"
#include "import/gltf/shape_resource_upgrade.h"

#include <string>

namespace imgeo::gltf {

/// The material of this name: KHR_materials_common, or values of the same names in a material with a program of its
/// own. `upgrade` has the bytes of images. Throws Error{malformed, truncated, limit} for invalid values.
ResourceMaterial readResourceMaterial(const Value& root, ShapeResourceUpgrade& upgrade, const std::string& key);

} // namespace imgeo::gltf
