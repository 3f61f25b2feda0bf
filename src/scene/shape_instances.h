#pragma once
// Instances of shapes: the scene graph flattened to one world transform for each occurrence of a Shape node.

#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo {

/// A shape in one of the places where it stands.
struct ShapeInstance {
  std::size_t node = 0;
  Affine3d worldFromShape;
};

/// Every shape as often as it is seen, in document order. Throws Error{limit} naming
/// `location` for more than a million: groups of groups that are USEd grow without
/// measure.
std::vector<ShapeInstance> shapeInstances(const SceneGraph& graph, const std::string& location = "");

/// The same limit for all shapes, those included that are no Shape of ours but an X3D
/// source's element.
void checkShapeInstanceLimit(const SceneGraph& graph, const std::string& location);

} // namespace imgeo
