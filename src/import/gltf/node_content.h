#pragma once
// What nodes of a scene have of glTF's nodes, cameras and lights.

#include "import/gltf/value.h"
#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo::gltf {

/// The extras of a part of the document as JSON; empty without any.
std::string extrasOf(const Value& value);

/// `rotation`: a quaternion, x y z w.
Transform transformOfTrs(Vec3d translation, const std::vector<double>& rotation, Vec3d scale);

/// A Transform node, or a Group where the transform is the identity.
NodeContent transformOrGroup(Transform transform);

} // namespace imgeo::gltf
