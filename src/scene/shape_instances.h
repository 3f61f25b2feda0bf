#pragma once
// Instances of shapes: the scene graph flattened to one world transform for each occurrence of a Shape node.

#include "scene/scene.h"

#include <string>
#include <vector>

namespace imgeo {

/// An instance of a shape: a path from the root to the Shape node.
struct ShapeInstance {
  std::size_t node = 0;
  Affine3d worldFromShape;
};

/// All instances of all shapes, in document order. Throws Error{limit} with `location` for more than a million, since
/// nested groups that are USEd multiply instances exponentially.
std::vector<ShapeInstance> shapeInstances(const SceneGraph& graph, const std::string& location = "");

/// Throws the same Error if the instances of all shapes, Shape elements in GenericNodes included, exceed the limit.
void checkShapeInstanceLimit(const SceneGraph& graph, const std::string& location);

/// Shapes are drawn up to this scale and this distance from the origin.
inline constexpr double maxDrawableLength = 1e15;

/// Whether a shape can be drawn in single precision together with others: its map scales by 10^-15 to 10^15, or to
/// nothing, and moves it no farther than 10^15.
bool isDrawable(const Affine3d& worldFromShape);

} // namespace imgeo
