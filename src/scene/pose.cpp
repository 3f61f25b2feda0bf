#include "scene/pose.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

namespace imgeo {

namespace {

std::string_view fieldOf(const Route& route) {
  std::string_view field = route.toField;
  if (field.starts_with("set_"))
    field.remove_prefix(4);
  return field;
}

void apply(const SceneGraph& graph, const Route& route, InterpolatorKind kind, const std::vector<double>& value,
           Pose& pose) {
  const std::string_view field = fieldOf(route);
  if (std::holds_alternative<Displacer>(graph.nodes[route.toNode].content)) {
    if (kind == InterpolatorKind::scalar && field == "weight")
      pose.weights[route.toNode] = value[0];
    return;
  }
  const Transform* rest = std::get_if<Transform>(&graph.nodes[route.toNode].content);
  if (!rest)
    return;
  Transform& transform = pose.transforms.try_emplace(route.toNode, *rest).first->second;
  if (kind == InterpolatorKind::orientation && field == "rotation")
    transform.rotation = {{value[0], value[1], value[2]}, value[3]};
  if (kind == InterpolatorKind::position && field == "translation")
    transform.translation = {value[0], value[1], value[2]};
  if (kind == InterpolatorKind::position && field == "scale")
    transform.scale = {value[0], value[1], value[2]};
}

/// The interpolators that a TimeSensor drives.
std::vector<std::size_t> drivenBy(const SceneGraph& graph, std::size_t sensor) {
  std::vector<std::size_t> driven;
  for (const Route& route : graph.routes)
    if (route.fromNode == sensor && fieldOf(route) == "fraction" && interpolatorAt(graph, route.toNode))
      driven.push_back(route.toNode);
  return driven;
}

/// The inverse of an affine map; the identity for one that flattens.
Affine3d inverseOf(const Affine3d& a) {
  const double determinant = a.determinant();
  if (determinant == 0 || !std::isfinite(determinant))
    return {};
  const Vec3d x = cross(a.y, a.z) * (1 / determinant), y = cross(a.z, a.x) * (1 / determinant),
              z = cross(a.x, a.y) * (1 / determinant);
  Affine3d inverse{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}, {}};
  inverse.translation = inverse.direction(a.translation) * -1;
  return inverse;
}

} // namespace

const Interpolator* interpolatorAt(const SceneGraph& graph, std::size_t node) {
  const Interpolator* interpolator = std::get_if<Interpolator>(&graph.nodes[node].content);
  const bool isUsable =
      interpolator && !interpolator->keys.empty() && !isList(interpolator->kind) && faultOf(*interpolator).empty();
  return isUsable ? interpolator : nullptr;
}

std::vector<double> momentsOf(const SceneGraph& graph, std::size_t sensor, std::size_t maxCount) {
  assert(maxCount > 1);
  std::set<float> keys;
  for (const std::size_t node : drivenBy(graph, sensor)) {
    const std::vector<float>& of = std::get<Interpolator>(graph.nodes[node].content).keys;
    keys.insert(of.begin(), of.end());
  }
  std::vector<double> moments;
  for (const float key : keys) {
    if (!moments.empty())
      moments.push_back((moments.back() + key) / 2);
    moments.push_back(key);
  }
  if (moments.size() <= maxCount)
    return moments;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < maxCount; ++i)
    thinned.push_back(moments[i * (moments.size() - 1) / (maxCount - 1)]);
  return thinned;
}

Pose poseAt(const SceneGraph& graph, std::size_t sensor, double fraction) {
  const std::vector<std::size_t> driven = drivenBy(graph, sensor);
  const std::set<std::size_t> isDriven(driven.begin(), driven.end());
  Pose pose;
  for (const Route& route : graph.routes)
    if (isDriven.contains(route.fromNode)) {
      const Interpolator& interpolator = std::get<Interpolator>(graph.nodes[route.fromNode].content);
      apply(graph, route, interpolator.kind, valueAt(interpolator, fraction), pose);
    }
  return pose;
}

std::vector<Affine3d> worldFromNodes(const SceneGraph& graph, const Pose& pose) {
  std::vector<Affine3d> worldFromNode(graph.nodes.size());
  std::vector<bool> isKnown(graph.nodes.size());
  for (const std::size_t node : nodesInOrder(graph)) { // parents before children
    const auto posed = pose.transforms.find(node);
    if (const Transform* rest = std::get_if<Transform>(&graph.nodes[node].content))
      worldFromNode[node] = worldFromNode[node] * affineOf(posed != pose.transforms.end() ? posed->second : *rest);
    for (const std::size_t child : graph.nodes[node].children)
      if (!isKnown[child]) {
        isKnown[child] = true;
        worldFromNode[child] = worldFromNode[node];
      }
  }
  return worldFromNode;
}

std::map<std::size_t, std::size_t> humanoidOfShapes(const SceneGraph& graph) {
  std::map<std::size_t, std::size_t> humanoids;
  const auto visit = [&](const auto& self, std::size_t node, std::size_t humanoid) -> void {
    if (std::holds_alternative<Shape>(graph.nodes[node].content))
      humanoids[node] = humanoid;
    else
      for (const std::size_t child : graph.nodes[node].children)
        self(self, child, humanoid);
  };
  for (const std::size_t node : nodesInOrder(graph))
    if (std::holds_alternative<Humanoid>(graph.nodes[node].content))
      visit(visit, node, node);
  return humanoids;
}

std::vector<Affine3d> skinMatrices(const SceneGraph& graph, std::size_t humanoidNode,
                                   const std::vector<Affine3d>& worldFromNode) {
  const Humanoid& humanoid = std::get<Humanoid>(graph.nodes[humanoidNode].content);
  const Affine3d humanoidFromWorld = inverseOf(worldFromNode[humanoidNode]);
  std::vector<Affine3d> matrices;
  for (std::size_t i = 0; i < humanoid.joints.size(); ++i)
    matrices.push_back(humanoidFromWorld * worldFromNode[humanoid.joints[i]] * humanoid.inverseBindings[i]);
  return matrices;
}

} // namespace imgeo
