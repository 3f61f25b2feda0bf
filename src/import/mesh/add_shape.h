#pragma once
// Adds a mesh with its shape to a scene.

#include "scene/scene.h"

#include <string>
#include <utility>

namespace imgeo {

/// Adds a mesh and a root node named `shapeName`, whose shape draws the mesh.
inline void addShape(Scene& scene, Mesh mesh, std::string shapeName) {
  Shape shape;
  shape.mesh = scene.meshes.size();
  scene.meshes.push_back(std::move(mesh));
  addRoot(scene.graph, {std::move(shapeName), shape, {}, ""});
}

} // namespace imgeo
