#include "scene/moving_boxes.h"

#include "base/box_corners.h"
#include "scene/pose.h"
#include "scene/vertex_joints.h"

#include <algorithm>

namespace imgeo {

namespace {

/// Room around the boxes for what happens between two moments, as a part of their diagonals.
constexpr double margin = 0.01;
/// Moments of an animation that the boxes surround.
constexpr std::size_t maxMoments = 256;

void addCorners(Box3d& box, const Box3d& other, const Affine3d& map) {
  if (!other.empty())
    for (const Vec3d& corner : cornersOf(other))
      box.add(map.point(corner));
}

/// The least and the greatest weight of each Displacer.
struct WeightRange {
  double min = 0, max = 0;
};

std::map<std::size_t, WeightRange> weightRanges(const SceneGraph& graph) {
  std::map<std::size_t, WeightRange> ranges;
  for (const std::size_t node : nodesInOrder(graph))
    if (const Displacer* displacer = std::get_if<Displacer>(&graph.nodes[node].content))
      ranges[node] = {std::min(0.0, displacer->weight), std::max(0.0, displacer->weight)};
  for (const Route& route : graph.routes) {
    const Interpolator* interpolator = interpolatorAt(graph, route.fromNode);
    const auto range = ranges.find(route.toNode);
    if (!interpolator || interpolator->kind != InterpolatorKind::scalar || range == ranges.end())
      continue;
    for (const float value : interpolator->values) {
      range->second.min = std::min(range->second.min, double{value});
      range->second.max = std::max(range->second.max, double{value});
    }
  }
  return ranges;
}

/// By wedge: a box around the displaced position, whatever the weights.
std::vector<Box3d> displacedBoxes(const Scene& scene, const Node& shape,
                                  const std::map<std::size_t, WeightRange>& ranges) {
  const Mesh& mesh = scene.meshes[std::get<Shape>(shape.content).mesh];
  std::vector<Box3d> boxes(mesh.wedgeCount());
  for (std::size_t wedge = 0; wedge < boxes.size(); ++wedge)
    boxes[wedge].add(Vec3d(mesh.positions[mesh.wedgePositions[wedge]]));
  std::size_t displacer = 0;
  const std::size_t count = displacementCount(mesh);
  for (const std::size_t child : shape.children) {
    const auto range = ranges.find(child);
    if (range == ranges.end() || displacer == count)
      continue;
    const NamedAttribute& displacement = attributeOf(mesh, displacementName(displacer++));
    for (std::size_t wedge = 0; wedge < boxes.size(); ++wedge)
      for (int axis = 0; axis < 3; ++axis) {
        const double d = displacementAt(displacement, wedge)[axis];
        boxes[wedge].min[axis] += std::min(d * range->second.min, d * range->second.max);
        boxes[wedge].max[axis] += std::max(d * range->second.min, d * range->second.max);
      }
  }
  return boxes;
}

/// A shape of a Humanoid, with what moves with each joint, in the coordinates of the joint's matrix.
struct SkinnedShape {
  std::size_t node, humanoid;
  std::vector<Box3d> boxes; ///< by joint
};

/// `displaced`: see displacedBoxes().
SkinnedShape skinnedShapeOf(const SceneGraph& graph, std::size_t shapeNode, std::size_t humanoidNode, const Mesh& mesh,
                            const std::vector<Box3d>& displaced) {
  SkinnedShape shape{shapeNode, humanoidNode, {}};
  shape.boxes.resize(std::get<Humanoid>(graph.nodes[humanoidNode].content).joints.size());
  for (std::size_t wedge = 0; wedge < displaced.size(); ++wedge)
    visitJoints(mesh, jointSetCount(mesh), wedge,
                [&](std::size_t joint, double) { addCorners(shape.boxes.at(joint), displaced[wedge], {}); });
  return shape;
}

/// Enlarges Shape::movingBox to what joints move, at rest and at the moments of all animations.
void addMovedByJoints(SceneGraph& graph, const std::vector<SkinnedShape>& shapes) {
  const auto addPose = [&](const Pose& pose) {
    const std::vector<Affine3d> worldFromNode = worldFromNodes(graph, pose);
    for (const SkinnedShape& shape : shapes) {
      const std::vector<Affine3d> matrices = skinMatrices(graph, shape.humanoid, worldFromNode);
      for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        addCorners(std::get<Shape>(graph.nodes[shape.node].content).movingBox, shape.boxes[joint], matrices[joint]);
    }
  };
  if (shapes.empty())
    return;
  addPose({});
  for (const std::size_t node : nodesInOrder(graph))
    if (std::holds_alternative<TimeSensor>(graph.nodes[node].content))
      for (const double moment : momentsOf(graph, node, maxMoments))
        addPose(poseAt(graph, node, moment));
}

void addMargin(Box3d& box) {
  const double room = margin * length(box.size());
  box.min = box.min - Vec3d{room, room, room};
  box.max = box.max + Vec3d{room, room, room};
}

} // namespace

void setMovingBoxes(Scene& scene) {
  SceneGraph& graph = scene.graph;
  const std::map<std::size_t, std::size_t> humanoids = humanoidOfShapes(graph);
  const std::map<std::size_t, WeightRange> ranges = weightRanges(graph);
  std::vector<SkinnedShape> skinned;
  std::vector<std::size_t> moving;
  for (const std::size_t node : shapeNodes(graph)) {
    Shape& shape = std::get<Shape>(graph.nodes[node].content);
    const Mesh& mesh = scene.meshes[shape.mesh];
    if (!isDeformed(mesh))
      continue;
    moving.push_back(node);
    const std::vector<Box3d> displaced = displacedBoxes(scene, graph.nodes[node], ranges);
    const auto humanoid = humanoids.find(node);
    if (humanoid != humanoids.end() && jointSetCount(mesh) > 0)
      skinned.push_back(skinnedShapeOf(graph, node, humanoid->second, mesh, displaced));
    else
      for (const Box3d& box : displaced)
        addCorners(shape.movingBox, box, {});
  }
  addMovedByJoints(graph, skinned);
  for (const std::size_t node : moving)
    addMargin(std::get<Shape>(graph.nodes[node].content).movingBox);
}

} // namespace imgeo
