#include "scene/deformation.h"

#include "scene/vertex_joints.h"

#include <algorithm>

namespace imgeo {

namespace {

double weightOf(const SceneGraph& graph, std::size_t displacer, const Pose& pose) {
  const auto posed = pose.weights.find(displacer);
  const Displacer* rest = std::get_if<Displacer>(&graph.nodes[displacer].content);
  return posed != pose.weights.end() ? posed->second : rest ? rest->weight : 0;
}

struct Vertex {
  Vec3d position, normal;
};

/// Displacements of a mesh with the weight that their Displacer has in a pose.
struct WeightedDisplacement {
  double weight;
  const NamedAttribute& positions;
  const NamedAttribute* normals; ///< nullptr where normals are not displaced
};

/// The n-th Displacer among the children of a shape has the mesh's n-th displacements.
std::vector<WeightedDisplacement> displacementsIn(const SceneGraph& graph, std::size_t shapeNode, const Mesh& mesh,
                                                  const Pose& pose) {
  std::vector<WeightedDisplacement> displacements;
  const std::size_t count = displacementCount(mesh);
  for (const std::size_t child : graph.nodes[shapeNode].children) {
    const std::size_t displacer = displacements.size();
    if (!std::holds_alternative<Displacer>(graph.nodes[child].content) || displacer == count)
      continue;
    const auto normals =
        std::ranges::find(mesh.namedAttributes, normalDisplacementName(displacer), &NamedAttribute::name);
    displacements.push_back({weightOf(graph, child, pose), attributeOf(mesh, displacementName(displacer)),
                             normals != mesh.namedAttributes.end() ? &*normals : nullptr});
  }
  return displacements;
}

void displace(Vertex& vertex, const std::vector<WeightedDisplacement>& displacements, std::size_t wedge) {
  for (const auto& [weight, positions, normals] : displacements) {
    vertex.position = vertex.position + displacementAt(positions, wedge) * weight;
    if (normals)
      vertex.normal = vertex.normal + displacementAt(*normals, wedge) * weight;
  }
}

/// See skinMatrices(); empty for a shape without joints.
std::vector<Affine3d> jointMatrices(const SceneGraph& graph, std::size_t shapeNode, const Mesh& mesh,
                                    const Pose& pose) {
  const std::map<std::size_t, std::size_t> humanoids = humanoidOfShapes(graph);
  const auto humanoid = humanoids.find(shapeNode);
  if (humanoid == humanoids.end() || jointSetCount(mesh) == 0)
    return {};
  return skinMatrices(graph, humanoid->second, worldFromNodes(graph, pose));
}

void moveByJoints(Vertex& vertex, const Mesh& mesh, const std::vector<Affine3d>& joints, std::size_t wedge) {
  Affine3d map{{}, {}, {}, {}};
  visitJoints(mesh, jointSetCount(mesh), wedge, [&](std::size_t joint, double weight) {
    const Affine3d& of = joints.at(joint);
    map = {map.x + of.x * weight, map.y + of.y * weight, map.z + of.z * weight,
           map.translation + of.translation * weight};
  });
  vertex.position = map.point(vertex.position);
  vertex.normal = normalMatrixOf(map).direction(vertex.normal);
}

} // namespace

Mesh posedMesh(const Scene& scene, std::size_t shapeNode, const Pose& pose) {
  Mesh mesh = scene.meshes[std::get<Shape>(scene.graph.nodes[shapeNode].content).mesh];
  const std::vector<WeightedDisplacement> displacements = displacementsIn(scene.graph, shapeNode, mesh, pose);
  const std::vector<Affine3d> joints = jointMatrices(scene.graph, shapeNode, mesh, pose);
  std::vector<Vec3f> positions; // one for each wedge: wedges of a position may move apart
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    Vertex vertex{Vec3d(mesh.positions[mesh.wedgePositions[wedge]]),
                  mesh.normals.empty() ? Vec3d{} : Vec3d(mesh.normals[wedge])};
    displace(vertex, displacements, wedge);
    if (!joints.empty())
      moveByJoints(vertex, mesh, joints, wedge);
    positions.push_back(Vec3f(vertex.position));
    if (const double size = length(vertex.normal); !mesh.normals.empty() && size > 0)
      mesh.normals[wedge] = Vec3f(vertex.normal * (1 / size));
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

} // namespace imgeo
