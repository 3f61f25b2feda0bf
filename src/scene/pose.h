#pragma once
// A scene at a moment of its animations: where its Transforms are then, and what moves the vertices of its shapes.

#include "scene/scene.h"

#include <map>
#include <vector>

namespace imgeo {

/// Values that differ from those of the scene at rest, by node.
struct Pose {
  std::map<std::size_t, Transform> transforms;
  std::map<std::size_t, double> weights; ///< of Displacers
};

/// The fractions at which the animation of a TimeSensor is looked at: all keys of its interpolators, and the middle
/// between two; if these are more than `maxCount`, which is at least 2, that many of them.
std::vector<double> momentsOf(const SceneGraph& graph, std::size_t sensor, std::size_t maxCount);

/// The scene when a TimeSensor sends this fraction (0 to 1).
Pose poseAt(const SceneGraph& graph, std::size_t sensor, double fraction);

/// The affine maps of all nodes to the coordinates of the scene, at the first instance of each.
std::vector<Affine3d> worldFromNodes(const SceneGraph& graph, const Pose& pose = {});

/// By node: the Humanoid whose skin a Shape is; absent for other nodes.
std::map<std::size_t, std::size_t> humanoidOfShapes(const SceneGraph& graph);

/// The well-formed interpolator at a node, unless it is one of lists; else nullptr.
const Interpolator* interpolatorAt(const SceneGraph& graph, std::size_t node);

/// For each joint of a Humanoid the map from the coordinates of its shapes to those of the same shapes in a pose, of
/// which `worldFromNode` are the worldFromNodes().
std::vector<Affine3d> skinMatrices(const SceneGraph& graph, std::size_t humanoidNode,
                                   const std::vector<Affine3d>& worldFromNode);

} // namespace imgeo
