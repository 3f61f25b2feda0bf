#include "export/gltf_deformation.h"

#include "scene/vertex_joints.h"

#include <algorithm>

namespace imgeo {

namespace {

std::size_t addFloats(GltfArrays& arrays, const std::vector<float>& values, const char* type, std::size_t count) {
  arrays.begin();
  for (const float value : values)
    appendLittle(arrays.bytes, value);
  return arrays.end(arrayBuffer, floatType, type, count);
}

std::size_t addJointsOf(GltfArrays& arrays, const NamedAttribute& joints) {
  arrays.begin();
  for (const float joint : joints.values)
    appendLittle(arrays.bytes, static_cast<std::uint16_t>(std::clamp(joint, 0.0f, 65535.0f)));
  return arrays.end(arrayBuffer, unsignedShort, "VEC4", joints.count());
}

/// Weights whose sum over all sets is one, which they have lost by rounding.
std::vector<std::vector<float>> scaledWeights(const Mesh& mesh) {
  std::vector<std::vector<float>> sets;
  for (std::size_t set = 0; set < jointSetCount(mesh); ++set)
    sets.push_back(attributeOf(mesh, jointWeightsName(set)).values);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    float sum = 0;
    for (const std::vector<float>& weights : sets)
      for (std::size_t i = 4 * wedge; i < 4 * wedge + 4; ++i)
        sum += weights[i];
    for (std::vector<float>& weights : sets)
      for (std::size_t i = 4 * wedge; i < 4 * wedge + 4 && sum > 0; ++i)
        weights[i] /= sum;
  }
  return sets;
}

/// Displacements of positions state their range, as glTF requires.
std::size_t addDisplacement(GltfArrays& arrays, const NamedAttribute& displacement) {
  const std::size_t accessor = addFloats(arrays, displacement.values, "VEC3", displacement.count());
  Vec3f min, max;
  for (std::size_t i = 0; i < displacement.values.size(); ++i) {
    const int axis = static_cast<int>(i % 3);
    min[axis] = i < 3 ? displacement.values[i] : std::min(min[axis], displacement.values[i]);
    max[axis] = i < 3 ? displacement.values[i] : std::max(max[axis], displacement.values[i]);
  }
  arrays.accessors.back()["min"] = {min.x, min.y, min.z};
  arrays.accessors.back()["max"] = {max.x, max.y, max.z};
  return accessor;
}

} // namespace

void addDeformation(GltfArrays& arrays, const Mesh& mesh, Json& primitive) {
  const std::vector<std::vector<float>> weights = scaledWeights(mesh);
  for (std::size_t set = 0; set < weights.size(); ++set) {
    const std::string suffix = std::to_string(set);
    primitive["attributes"]["JOINTS_" + suffix] = addJointsOf(arrays, attributeOf(mesh, jointsName(set)));
    primitive["attributes"]["WEIGHTS_" + suffix] = addFloats(arrays, weights[set], "VEC4", mesh.wedgeCount());
  }
  for (std::size_t i = 0; i < displacementCount(mesh); ++i) {
    Json target{{"POSITION", addDisplacement(arrays, attributeOf(mesh, displacementName(i)))}};
    const auto normals = std::ranges::find(mesh.namedAttributes, normalDisplacementName(i), &NamedAttribute::name);
    if (normals != mesh.namedAttributes.end())
      target["NORMAL"] = addFloats(arrays, normals->values, "VEC3", normals->count());
    primitive["targets"].push_back(std::move(target));
  }
}

Json gltfSkin(GltfArrays& arrays, const Humanoid& humanoid,
              const std::map<std::size_t, std::vector<std::size_t>>& gltfNodes) {
  if (!std::ranges::all_of(humanoid.joints, [&](std::size_t joint) { return gltfNodes.contains(joint); }))
    return {};
  std::vector<float> matrices;
  for (const Affine3d& map : humanoid.inverseBindings)
    for (const auto& [column, last] : {std::pair(map.x, 0), {map.y, 0}, {map.z, 0}, {map.translation, 1}})
      for (const double number : {column.x, column.y, column.z, static_cast<double>(last)})
        matrices.push_back(static_cast<float>(number));
  Json joints = Json::array();
  for (const std::size_t joint : humanoid.joints)
    joints.push_back(gltfNodes.at(joint).front());
  const std::size_t accessor = addFloats(arrays, matrices, "MAT4", humanoid.joints.size());
  arrays.views.back().erase("target"); // only vertex data has one
  return {{"joints", std::move(joints)}, {"inverseBindMatrices", accessor}};
}

std::vector<std::size_t> displacersOf(const Scene& scene, std::size_t shapeNode) {
  const Node& node = scene.graph.nodes[shapeNode];
  std::vector<std::size_t> displacers;
  std::ranges::copy_if(node.children, std::back_inserter(displacers), [&](std::size_t child) {
    return std::holds_alternative<Displacer>(scene.graph.nodes[child].content);
  });
  displacers.resize(std::min(displacers.size(), displacementCount(scene.meshes[std::get<Shape>(node.content).mesh])));
  return displacers;
}

} // namespace imgeo
