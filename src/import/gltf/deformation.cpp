#include "import/gltf/deformation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace imgeo::gltf {

namespace {

/// The largest deviation of a sum of weights from one that is called rounding: weights may be bytes.
constexpr double weightRounding = 0.01;

Affine3d matrixOf(const Accessor& accessor, std::size_t element, const Value& location) {
  double m[16];
  for (std::uint32_t i = 0; i < 16; ++i) {
    m[i] = accessor.real(element, i);
    if (!std::isfinite(m[i]))
      location.fail(ErrorKind::malformed, fmt::format("of joint {} is not finite", element));
  }
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1)
    location.fail(ErrorKind::malformed, fmt::format("of joint {} is no affine map", element));
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

const PrimitiveData::Attribute* jointsOf(const Value& primitive, const PrimitiveData& data, const char* name,
                                         std::size_t set) {
  const std::string stored = fmt::format("{}_{}", name, set);
  const PrimitiveData::Attribute* found = data.find(stored);
  if (found && found->components != 4)
    primitive["attributes"][stored.c_str()].fail(ErrorKind::malformed, "has the wrong number of components");
  return found;
}

/// Adds the displacements of one attribute of a target; zeros where the target lacks it.
void addDisplacement(Document& document, const Value& target, const char* attribute, std::string name,
                     std::size_t vertexCount, const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  NamedAttribute displacement{std::move(name), 3, std::vector<float>(3 * vertices.size())};
  document.spend(target, displacement.values.size() * sizeof(float));
  if (const std::optional<std::size_t> index = target.index(attribute, document.array("accessors"))) {
    const Accessor accessor = document.accessor(*index);
    if (accessor.components() != 3 || accessor.count() != vertexCount)
      target[attribute].fail(ErrorKind::malformed, fmt::format("has {} elements of {} numbers for {} vertices",
                                                               accessor.count(), accessor.components(), vertexCount));
    for (std::size_t i = 0; i < displacement.values.size(); ++i) {
      displacement.values[i] = static_cast<float>(accessor.real(vertices[i / 3], static_cast<std::uint32_t>(i % 3)));
      if (!std::isfinite(displacement.values[i]))
        target[attribute].fail(ErrorKind::malformed, fmt::format("of vertex {} is not a number", vertices[i / 3]));
    }
  }
  mesh.namedAttributes.push_back(std::move(displacement));
}

} // namespace

Skin readSkin(Document& document, std::size_t index) {
  const Value value = document.array("skins")[index], joints = value["joints"], nodes = document.array("nodes");
  Skin skin;
  if (joints.size() == 0)
    value.fail(ErrorKind::malformed, "has no joints");
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const std::uint64_t node = joints[i].whole();
    if (node >= nodes.size())
      joints[i].fail(ErrorKind::malformed, fmt::format("names node {} of {}", node, nodes.size()));
    skin.joints.push_back(node);
  }
  skin.inverseBindings.resize(skin.joints.size()); // the identity where the skin states none
  const std::optional<std::size_t> matrices = value.index("inverseBindMatrices", document.array("accessors"));
  if (!matrices)
    return skin;
  const Accessor accessor = document.accessor(*matrices);
  const Value location = value["inverseBindMatrices"];
  if (accessor.components() != 16 || accessor.count() < skin.joints.size())
    location.fail(ErrorKind::malformed, fmt::format("has {} elements of {} numbers for {} joints", accessor.count(),
                                                    accessor.components(), skin.joints.size()));
  for (std::size_t i = 0; i < skin.joints.size(); ++i)
    skin.inverseBindings[i] = matrixOf(accessor, i, location);
  return skin;
}

std::set<std::size_t> jointNodes(Document& document) {
  std::set<std::size_t> used, joints;
  const Value nodes = document.array("nodes"), skins = document.array("skins");
  const auto wholeBelow = [](const Value& value, std::size_t limit) {
    return value.json().is_number_unsigned() && value.whole() < limit;
  };
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (nodes[i].has("mesh") && wholeBelow(nodes[i]["skin"], skins.size()))
      used.insert(nodes[i]["skin"].whole());
  for (const std::size_t skin : used)
    for (std::size_t i = 0; i < skins[skin]["joints"].size(); ++i)
      if (const Value joint = skins[skin]["joints"][i]; wholeBelow(joint, nodes.size()))
        joints.insert(joint.whole());
  return joints;
}

std::size_t addJoints(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                      std::size_t jointCount, Mesh& mesh) {
  struct Set {
    const PrimitiveData::Attribute *joints, *weights;
  };
  std::vector<Set> sets;
  for (std::size_t n = 0; n < maxJointSets; ++n) {
    const Set set{jointsOf(primitive, data, "JOINTS", n), jointsOf(primitive, data, "WEIGHTS", n)};
    if (!set.joints != !set.weights)
      primitive["attributes"].fail(ErrorKind::malformed, fmt::format("has only one of JOINTS_{0} and WEIGHTS_{0}", n));
    if (!set.joints)
      break;
    sets.push_back(set);
  }
  if (sets.empty())
    primitive["attributes"].fail(ErrorKind::malformed, "has no JOINTS_0, though its node has a skin");
  const std::size_t first = mesh.namedAttributes.size();
  for (std::size_t n = 0; n < sets.size(); ++n) {
    mesh.namedAttributes.push_back({jointsName(n), 4, {}});
    mesh.namedAttributes.push_back({jointWeightsName(n), 4, {}});
  }
  std::size_t scaled = 0;
  for (const std::uint32_t vertex : vertices) {
    double sum = 0;
    for (const Set& set : sets)
      for (std::uint32_t c = 0; c < 4; ++c) {
        const double weight = set.weights->number(vertex, c);
        if (!std::isfinite(weight) || weight < 0)
          primitive["attributes"]["WEIGHTS_0"].fail(ErrorKind::malformed,
                                                    fmt::format("of vertex {} is negative or not a number", vertex));
        sum += weight;
      }
    scaled += std::abs(sum - 1) > weightRounding;
    for (std::size_t n = 0; n < sets.size(); ++n)
      for (std::uint32_t c = 0; c < 4; ++c) {
        const bool isOnly = sum == 0 && n == 0 && c == 0;
        const double weight = isOnly ? 1 : sum == 0 ? 0 : sets[n].weights->number(vertex, c) / sum;
        const double joint = sets[n].joints->number(vertex, c);
        if (weight > 0 && !(joint >= 0 && joint < static_cast<double>(jointCount)))
          primitive["attributes"]["JOINTS_0"].fail(
              ErrorKind::malformed, fmt::format("of vertex {} names joint {} of {}", vertex, joint, jointCount));
        // What has no weight may name any joint: the first one compresses best.
        mesh.namedAttributes[first + 2 * n].values.push_back(weight > 0 ? static_cast<float>(joint) : 0);
        mesh.namedAttributes[first + 2 * n + 1].values.push_back(static_cast<float>(weight));
      }
  }
  return scaled;
}

void addDisplacements(Document& document, const Value& primitive, std::size_t vertexCount,
                      const std::vector<std::uint32_t>& vertices, Mesh& mesh) {
  const Value targets = primitive["targets"];
  if (targets.size() > maxDisplacers)
    targets.fail(ErrorKind::unsupported,
                 fmt::format("has {} morph targets; imgeo reads up to {}", targets.size(), maxDisplacers));
  bool haveNormals = false;
  for (std::size_t t = 0; t < targets.size(); ++t)
    haveNormals = haveNormals || targets[t].has("NORMAL");
  haveNormals = haveNormals && !mesh.normals.empty();
  for (std::size_t t = 0; t < targets.size(); ++t) {
    addDisplacement(document, targets[t], "POSITION", displacementName(t), vertexCount, vertices, mesh);
    if (haveNormals)
      addDisplacement(document, targets[t], "NORMAL", normalDisplacementName(t), vertexCount, vertices, mesh);
  }
}

std::vector<Displacer> displacersOf(const Value& node, const Value& mesh, std::size_t count) {
  std::vector<Displacer> displacers(count);
  const Json names = mesh["extras"].json().is_object() ? mesh["extras"]["targetNames"].json() : Json{};
  for (std::size_t i = 0; i < count && names.is_array() && i < names.size(); ++i)
    if (names[i].is_string())
      displacers[i].name = names[i].get<std::string>();
  const Value weights = node.has("weights") ? node["weights"] : mesh["weights"];
  if (weights.isAbsent())
    return displacers;
  const std::vector<double> numbers = weights.reals(count, {});
  for (std::size_t i = 0; i < count; ++i)
    displacers[i].weight = numbers[i];
  return displacers;
}

} // namespace imgeo::gltf
