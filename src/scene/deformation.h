#pragma once
// Meshes whose vertices joints and displacers have moved.

#include "scene/pose.h"

namespace imgeo {

/// Moves the vertices and turns the normals of a Shape's mesh to a pose.
Mesh posedMesh(const Scene& scene, std::size_t shapeNode, const Pose& pose = {});

/// A copy of the scene, if it has shapes with joints or displacers, in which each of them has its own mesh, at rest.
std::optional<Scene> atRest(const Scene& scene);

/// Gives all such shapes their form at rest for good. Returns the number of their meshes.
std::size_t removeDeformations(Scene& scene);

} // namespace imgeo
