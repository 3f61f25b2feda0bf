#pragma once
// A scene at a moment of its animations: where its Transforms are then, and which form its deformed shapes have.

#include "scene/scene.h"

#include <map>
#include <vector>

namespace imgeo {

/// Values that differ from those of the scene at rest, by node.
struct Pose {
  std::map<std::size_t, Transform> transforms;
  std::map<std::size_t, double> weights; ///< of Displacers
};

/// The scene when a TimeSensor sends this fraction (0 to 1).
Pose poseAt(const SceneGraph& graph, std::size_t sensor, double fraction);

/// The affine maps of all nodes to the coordinates of the scene, at the first instance of each.
std::vector<Affine3d> worldFromNodes(const SceneGraph& graph, const Pose& pose = {});

/// By node: the Humanoid whose skin a Shape is; absent for other nodes.
std::map<std::size_t, std::size_t> humanoidOfShapes(const SceneGraph& graph);

/// Moves the vertices and turns the normals of a Shape's mesh to a pose.
Mesh posedMesh(const Scene& scene, std::size_t shapeNode, const Pose& pose = {});

/// A copy of the scene, if it has shapes with joints or displacers, in which each of them has its own mesh, at rest.
std::optional<Scene> atRest(const Scene& scene);

/// Gives all such shapes their form at rest for good. Returns the number of their meshes.
std::size_t removeDeformations(Scene& scene);

/// Sets Shape::movingBox of all shapes with joints or displacers: around the vertices at rest and in all animations.
void setMovingBoxes(Scene& scene);

} // namespace imgeo
