#include "scene/pose.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace imgeo {

namespace {

/// Moments at which an animation is looked at; more keys are thinned out.
constexpr std::size_t maxMoments = 256;
/// Room around the boxes for what happens between two moments, as a part of their diagonals.
constexpr double margin = 0.01;

Rotation between(const Rotation& a, const Rotation& b, double t) {
  std::array<double, 4> from = quaternionOf(a), to = quaternionOf(b);
  double cosine = 0;
  for (std::size_t i = 0; i < 4; ++i)
    cosine += from[i] * to[i];
  const double sign = cosine < 0 ? -1 : 1, angle = std::acos(std::min(1.0, std::abs(cosine)));
  const double f = angle > 1e-6 ? std::sin((1 - t) * angle) / std::sin(angle) : 1 - t;
  const double g = sign * (angle > 1e-6 ? std::sin(t * angle) / std::sin(angle) : t);
  for (std::size_t i = 0; i < 4; ++i)
    from[i] = f * from[i] + g * to[i];
  return rotationOfQuaternion(from[0], from[1], from[2], from[3]);
}

/// The numbers of a well-formed interpolator at a fraction.
std::vector<double> valueAt(const Interpolator& interpolator, double fraction) {
  const std::vector<float>& keys = interpolator.keys;
  const std::size_t components = componentsOf(interpolator.kind);
  const auto numbers = [&](std::size_t key) {
    const auto begin = interpolator.values.begin() + static_cast<std::ptrdiff_t>(key * components);
    return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(components));
  };
  const auto after = static_cast<std::size_t>(std::ranges::upper_bound(keys, fraction) - keys.begin());
  if (after == 0 || after == keys.size())
    return numbers(after == 0 ? 0 : after - 1);
  const double t = (fraction - keys[after - 1]) / (double{keys[after]} - keys[after - 1]);
  std::vector<double> a = numbers(after - 1), b = numbers(after);
  if (interpolator.kind == InterpolatorKind::orientation) {
    const Rotation r = between({{a[0], a[1], a[2]}, a[3]}, {{b[0], b[1], b[2]}, b[3]}, t);
    return {r.axis.x, r.axis.y, r.axis.z, r.angle};
  }
  for (std::size_t c = 0; c < components; ++c)
    a[c] += t * (b[c] - a[c]);
  return a;
}

/// The well-formed interpolator at which a route begins, or nullptr.
const Interpolator* interpolatorAt(const SceneGraph& graph, std::size_t node) {
  const Interpolator* interpolator = std::get_if<Interpolator>(&graph.nodes[node].content);
  const bool isUsable =
      interpolator && !interpolator->keys.empty() && !isList(interpolator->kind) && faultOf(*interpolator).empty();
  return isUsable ? interpolator : nullptr;
}

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

/// The fractions at which an animation is looked at: its keys, and the middle between two.
std::vector<double> momentsOf(const SceneGraph& graph, std::size_t sensor) {
  std::set<float> keys;
  for (const std::size_t node : drivenBy(graph, sensor))
    keys.insert(std::get<Interpolator>(graph.nodes[node].content).keys.begin(),
                std::get<Interpolator>(graph.nodes[node].content).keys.end());
  std::vector<double> moments;
  for (const float key : keys) {
    if (!moments.empty())
      moments.push_back((moments.back() + key) / 2);
    moments.push_back(key);
  }
  if (moments.size() <= maxMoments)
    return moments;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < maxMoments; ++i)
    thinned.push_back(moments[i * (moments.size() - 1) / (maxMoments - 1)]);
  return thinned;
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

const NamedAttribute& attributeOf(const Mesh& mesh, const std::string& name) {
  return *std::ranges::find(mesh.namedAttributes, name, &NamedAttribute::name);
}

double weightOf(const SceneGraph& graph, std::size_t displacer, const Pose& pose) {
  const auto posed = pose.weights.find(displacer);
  const Displacer* rest = std::get_if<Displacer>(&graph.nodes[displacer].content);
  return posed != pose.weights.end() ? posed->second : rest ? rest->weight : 0;
}

Vec3d at(const NamedAttribute& attribute, std::size_t wedge) {
  return {attribute.values[3 * wedge], attribute.values[3 * wedge + 1], attribute.values[3 * wedge + 2]};
}

/// For each joint the map from the coordinates of a Humanoid's shapes to those of the same shapes in a pose.
std::vector<Affine3d> skinMatrices(const SceneGraph& graph, std::size_t humanoidNode,
                                   const std::vector<Affine3d>& worldFromNode) {
  const Humanoid& humanoid = std::get<Humanoid>(graph.nodes[humanoidNode].content);
  const Affine3d humanoidFromWorld = inverseOf(worldFromNode[humanoidNode]);
  std::vector<Affine3d> matrices;
  for (std::size_t i = 0; i < humanoid.joints.size(); ++i)
    matrices.push_back(humanoidFromWorld * worldFromNode[humanoid.joints[i]] * humanoid.inverseBindings[i]);
  return matrices;
}

/// The joints that move a vertex, with their weights.
template <typename Visit> void visitJoints(const Mesh& mesh, std::size_t setCount, std::size_t wedge, Visit visit) {
  for (std::size_t set = 0; set < setCount; ++set) {
    const NamedAttribute &joints = attributeOf(mesh, jointsName(set)),
                         &weights = attributeOf(mesh, jointWeightsName(set));
    for (std::size_t i = 4 * wedge; i < 4 * wedge + 4; ++i)
      if (weights.values[i] > 0)
        visit(static_cast<std::size_t>(joints.values[i]), double{weights.values[i]});
  }
}

void addCorners(Box3d& box, const Box3d& other, const Affine3d& map) {
  for (int corner = 0; corner < 8 && !other.empty(); ++corner)
    box.add(map.point({corner & 1 ? other.max.x : other.min.x, corner & 2 ? other.max.y : other.min.y,
                       corner & 4 ? other.max.z : other.min.z}));
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
        const double d = at(displacement, wedge)[axis];
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

} // namespace

Pose poseAt(const SceneGraph& graph, std::size_t sensor, double fraction) {
  Pose pose;
  for (const std::size_t node : drivenBy(graph, sensor)) {
    const Interpolator& interpolator = std::get<Interpolator>(graph.nodes[node].content);
    const std::vector<double> value = valueAt(interpolator, fraction);
    for (const Route& route : graph.routes)
      if (route.fromNode == node)
        apply(graph, route, interpolator.kind, value, pose);
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

Mesh posedMesh(const Scene& scene, std::size_t shapeNode, const Pose& pose) {
  const SceneGraph& graph = scene.graph;
  const Node& shape = graph.nodes[shapeNode];
  Mesh mesh = scene.meshes[std::get<Shape>(shape.content).mesh];
  const std::size_t setCount = jointSetCount(mesh), displacementsOfMesh = displacementCount(mesh);
  const std::map<std::size_t, std::size_t> humanoids = humanoidOfShapes(graph);
  const auto humanoid = humanoids.find(shapeNode);
  const std::vector<Affine3d> matrices = humanoid == humanoids.end() || setCount == 0
                                             ? std::vector<Affine3d>{}
                                             : skinMatrices(graph, humanoid->second, worldFromNodes(graph, pose));
  std::vector<Vec3f> positions; // one for each wedge: wedges of a position may move apart
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    Vec3d position(mesh.positions[mesh.wedgePositions[wedge]]);
    Vec3d normal = mesh.normals.empty() ? Vec3d{} : Vec3d(mesh.normals[wedge]);
    std::size_t displacer = 0;
    for (const std::size_t child : shape.children) {
      if (!std::holds_alternative<Displacer>(graph.nodes[child].content) || displacer == displacementsOfMesh)
        continue;
      const double weight = weightOf(graph, child, pose);
      position = position + at(attributeOf(mesh, displacementName(displacer)), wedge) * weight;
      const auto turned =
          std::ranges::find(mesh.namedAttributes, normalDisplacementName(displacer++), &NamedAttribute::name);
      if (turned != mesh.namedAttributes.end())
        normal = normal + at(*turned, wedge) * weight;
    }
    if (!matrices.empty()) {
      Affine3d map{{}, {}, {}, {}};
      visitJoints(mesh, setCount, wedge, [&](std::size_t joint, double weight) {
        const Affine3d& of = matrices.at(joint);
        map = {map.x + of.x * weight, map.y + of.y * weight, map.z + of.z * weight,
               map.translation + of.translation * weight};
      });
      position = map.point(position);
      normal = normalMatrixOf(map).direction(normal);
    }
    positions.push_back(Vec3f(position));
    if (const double size = length(normal); !mesh.normals.empty() && size > 0)
      mesh.normals[wedge] = Vec3f(normal * (1 / size));
    mesh.wedgePositions[wedge] = static_cast<std::uint32_t>(wedge);
  }
  mesh.positions = std::move(positions);
  std::erase_if(mesh.namedAttributes, [](const NamedAttribute& each) { return isOfDeformation(each.name); });
  return mesh;
}

std::optional<Scene> atRest(const Scene& scene) {
  if (std::ranges::none_of(scene.meshes, isDeformed))
    return {};
  Scene rest = scene;
  for (const std::size_t node : shapeNodes(scene.graph)) {
    Shape& shape = std::get<Shape>(rest.graph.nodes[node].content);
    if (!isDeformed(scene.meshes[shape.mesh]))
      continue;
    rest.meshes.push_back(posedMesh(scene, node));
    shape.mesh = rest.meshes.size() - 1;
  }
  return rest;
}

std::size_t removeDeformations(Scene& scene) {
  const auto count = static_cast<std::size_t>(std::ranges::count_if(scene.meshes, isDeformed));
  if (count == 0)
    return 0;
  scene = *atRest(scene);
  for (Node& node : scene.graph.nodes) {
    if (std::holds_alternative<Humanoid>(node.content))
      node.content = Group{};
    if (Transform* transform = std::get_if<Transform>(&node.content))
      transform->isJoint = false;
    std::erase_if(node.children, [&](std::size_t child) {
      return std::holds_alternative<Displacer>(scene.graph.nodes[child].content);
    });
  }
  std::erase_if(scene.graph.routes, [&](const Route& route) {
    return std::holds_alternative<Displacer>(scene.graph.nodes[route.toNode].content);
  });
  return count;
}

void setMovingBoxes(Scene& scene) {
  SceneGraph& graph = scene.graph;
  const std::map<std::size_t, std::size_t> humanoids = humanoidOfShapes(graph);
  const std::map<std::size_t, WeightRange> ranges = weightRanges(graph);
  std::vector<SkinnedShape> skinned;
  std::vector<std::size_t> moving;
  for (const std::size_t node : shapeNodes(graph)) {
    Shape& shape = std::get<Shape>(graph.nodes[node].content);
    const Mesh& mesh = scene.meshes[shape.mesh];
    const std::size_t setCount = jointSetCount(mesh);
    const auto humanoid = humanoids.find(node);
    if (!isDeformed(mesh))
      continue;
    moving.push_back(node);
    const std::vector<Box3d> boxes = displacedBoxes(scene, graph.nodes[node], ranges);
    if (humanoid == humanoids.end() || setCount == 0) {
      for (const Box3d& box : boxes)
        addCorners(shape.movingBox, box, {});
      continue;
    }
    SkinnedShape added{node, humanoid->second, {}};
    added.boxes.resize(std::get<Humanoid>(graph.nodes[humanoid->second].content).joints.size());
    for (std::size_t wedge = 0; wedge < boxes.size(); ++wedge)
      visitJoints(mesh, setCount, wedge,
                  [&](std::size_t joint, double) { addCorners(added.boxes.at(joint), boxes[wedge], {}); });
    skinned.push_back(std::move(added));
  }
  const auto addPose = [&](const Pose& pose) {
    const std::vector<Affine3d> worldFromNode = worldFromNodes(graph, pose);
    for (const SkinnedShape& shape : skinned) {
      const std::vector<Affine3d> matrices = skinMatrices(graph, shape.humanoid, worldFromNode);
      for (std::size_t joint = 0; joint < matrices.size(); ++joint)
        addCorners(std::get<Shape>(graph.nodes[shape.node].content).movingBox, shape.boxes[joint], matrices[joint]);
    }
  };
  if (!skinned.empty()) {
    addPose({});
    for (const std::size_t node : nodesInOrder(graph))
      if (std::holds_alternative<TimeSensor>(graph.nodes[node].content))
        for (const double moment : momentsOf(graph, node))
          addPose(poseAt(graph, node, moment));
  }
  for (const std::size_t node : moving) {
    Box3d& box = std::get<Shape>(graph.nodes[node].content).movingBox;
    const double room = margin * length(box.size());
    box.min = box.min - Vec3d{room, room, room};
    box.max = box.max + Vec3d{room, room, room};
  }
}

} // namespace imgeo
