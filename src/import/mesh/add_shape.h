#pragma once
// Adds a mesh with its shape to a scene.

#include "scene/scene.h"

#include <optional>
#include <string>
#include <utility>

namespace imgeo {

/// Adds a mesh and a root node named `shapeName`, whose shape draws the mesh with
/// an appearance of the scene.
inline void addShape(Scene& scene, Mesh mesh, std::string shapeName,
                     const std::optional<std::size_t>& appearance = {}) {
  Shape shape;
  shape.appearance = appearance;
  shape.mesh = scene.meshes.size();
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {std::move(shapeName), shape, {}, ""});
}

} // namespace imgeo
