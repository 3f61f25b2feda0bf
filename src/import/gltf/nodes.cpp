#include "import/gltf/nodes.h"

#include "import/gltf/cameras_and_lights.h"
#include "import/gltf/instances.h"
#include "import/gltf/node_content.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace imgeo::gltf {

namespace {

constexpr std::size_t maxNodeDepth = 200;

/// The nodes of a scene's list. Throws Error{malformed} where it names one that is not there.
std::vector<std::size_t> rootsOf(const Value& scene, std::size_t nodeCount) {
  const Value list = scene["nodes"];
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::uint64_t node = list[i].whole();
    if (node >= nodeCount)
      list[i].fail(ErrorKind::malformed, fmt::format("names node {} of {}", node, nodeCount));
    roots.push_back(node);
  }
  return roots;
}

/// The nodes that are no node's child.
std::vector<std::size_t> nodesWithoutParent(const Value& nodes) {
  std::vector<bool> isChild(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t c = 0; c < nodes[i]["children"].size(); ++c)
      if (const std::uint64_t child = nodes[i]["children"][c].whole(); child < nodes.size())
        isChild[child] = true;
  std::vector<std::size_t> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    if (!isChild[i])
      roots.push_back(i);
  return roots;
}

} // namespace

/// Reads the NavigationInfo types that imgeo export writes into extras. Extras of other programs may hold anything.
void NodeReader::addNavigation(const Value& extras) {
  if (!extras.has("NavigationInfo") || !extras["NavigationInfo"].has("type"))
    return;
  std::vector<std::string> types;
  for (const Json& type : extras["NavigationInfo"]["type"].json())
    if (type.is_string())
      types.push_back(type.get<std::string>());
  if (!types.empty())
    addRoot(scene_.graph, {"", GenericNode{"NavigationInfo", "", {}}, {}, "", {{"type", quoteStrings(types)}}});
}

/// The names of the variants of KHR_materials_variants, in the order of the choices of their Switches.
void NodeReader::addVariantNames() {
  const Value variants = document_.root()["extensions"]["KHR_materials_variants"]["variants"];
  std::vector<std::string> names;
  for (std::size_t i = 0; i < variants.size(); ++i)
    names.push_back(variants[i]["name"].text());
  if (!names.empty())
    scene_.graph.info.push_back(fmt::format("variants: {}", fmt::join(names, ", ")));
}

void NodeReader::readScene() {
  const Value nodes = document_.array("nodes"), scenes = document_.array("scenes");
  visited_.assign(nodes.size(), false);
  std::vector<std::size_t> roots;
  const std::optional<std::size_t> chosen =
      scenes.size() > 0 ? document_.root().index("scene", scenes) : std::optional<std::size_t>();
  otherScenes = std::max<std::size_t>(scenes.size(), 1) - 1;
  if (scenes.size() > 0) {
    const Value scene = scenes[chosen.value_or(0)];
    scene_.graph.title = scene["name"].text();
    addNavigation(scene["extras"]);
    roots = rootsOf(scene, nodes.size());
  } else {
    roots = nodesWithoutParent(nodes);
  }
  addVariantNames();
  for (const std::size_t root : roots)
    if (const std::optional<std::size_t> node = readNode(root, 1, 1))
      scene_.graph.roots.push_back(*node);
  const Value meshes = document_.array("meshes");
  for (std::size_t i = 0; nodes.size() == 0 && i < meshes.size(); ++i)
    if (const std::optional<std::size_t> node = shapes_.meshNode(i, std::nullopt, 0))
      scene_.graph.roots.push_back(*node);
  for (const SkinnedShape& skinned : skinned_) // behind all joints: documents define a node before they USE it
    damage.attempt([&] { addHumanoid(skinned); });
  animatedNodes_.displacers = shapes_.displacers();
}

NodeContent NodeReader::contentOf(const Value& node) const {
  if (node.has("matrix")) {
    const std::vector<double> m = node["matrix"].reals(16, {});
    const Affine3d map{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    return transformOrGroup(map == Affine3d{} ? Transform{} : imgeo::transformOf(map));
  }
  return transformOrGroup(transformOfTrs(node["translation"].vec3({}), node["rotation"].reals(4, {0, 0, 0, 1}),
                                         node["scale"].vec3({1, 1, 1})));
}

std::optional<std::size_t> NodeReader::readNode(std::size_t index, std::size_t depth, double scale) {
  const Value value = document_.array("nodes")[index];
  if (depth > maxNodeDepth)
    value.fail(ErrorKind::limit, "is nested too deeply");
  if (visited_[index]) {
    damage.attempt([&] { value.fail(ErrorKind::malformed, "is the child of two nodes, or of itself"); });
    return {};
  }
  visited_[index] = true;
  Node node;
  node.name = value["name"].text();
  node.content = contentOf(value);
  const bool isMoved = moved_.contains(index) || joints_.contains(index);
  if (isMoved && !std::holds_alternative<Transform>(node.content))
    node.content = Transform{};
  if (joints_.contains(index))
    std::get<Transform>(node.content).isJoint = true;
  if (const Transform* transform = std::get_if<Transform>(&node.content))
    scale *= std::cbrt(std::abs(affineOf(*transform).determinant()));
  node.extras = extrasOf(value);
  if (!value["extensions"]["KHR_node_visibility"]["visible"].boolean(true))
    node.fields = {{"visible", "false"}};
  if (const auto mesh = value.index("mesh", document_.array("meshes"))) {
    std::optional<std::size_t> skin;
    damage.attempt([&] { skin = value.index("skin", document_.array("skins")); });
    if (!skin || !addSkinned(index, *mesh, *skin))
      if (const std::optional<std::size_t> shape = shapes_.meshNode(*mesh, index, 0))
        addShapes(value, *shape, node.children);
  }
  for (std::optional<Node>& child : std::array{cameraOf(document_, value), lightOf(document_, value, scale, damage)})
    if (child)
      node.children.push_back(addNode(scene_.graph, *std::move(child)));
  const Value children = value["children"];
  for (std::size_t i = 0; i < children.size(); ++i) {
    const std::uint64_t child = children[i].whole();
    if (child >= visited_.size())
      damage.attempt(
          [&] { children[i].fail(ErrorKind::malformed, fmt::format("names node {} of {}", child, visited_.size())); });
    else if (const std::optional<std::size_t> read = readNode(child, depth + 1, scale))
      node.children.push_back(*read);
  }
  // A group without name, extras and transform is replaced by its only child.
  if (node.name.empty() && node.extras.empty() && node.fields.empty() && node.children.size() == 1 &&
      std::holds_alternative<Group>(node.content))
    return node.children[0];
  const std::size_t added = addNode(scene_.graph, std::move(node));
  if (isMoved)
    animatedNodes_.transforms[index] = added;
  return added;
}

/// Adds the shape of a node, or its instances.
void NodeReader::addShapes(const Value& node, std::size_t shape, std::vector<std::size_t>& children) {
  const std::optional<std::vector<Transform>> instances = instanceTransforms(document_, node);
  if (!instances)
    children.push_back(shape);
  else
    for (const Transform& transform : *instances)
      children.push_back(addNode(scene_.graph, {"", transformOrGroup(transform), {shape}, ""}));
}

/// Adds the shapes of a node with a skin. They belong to no node of the document: glTF ignores the node's transform.
/// Returns false, with a warning, where the skin or its vertices are damaged: the mesh is then drawn as it was
/// modelled.
bool NodeReader::addSkinned(std::size_t node, std::size_t mesh, std::size_t skin) {
  const std::size_t before = damage.warnings.size();
  damage.attempt([&] {
    const std::size_t jointCount = readSkin(document_, skin).joints.size();
    if (const std::optional<std::size_t> shape = shapes_.meshNode(mesh, node, jointCount))
      skinned_.push_back({node, skin, *shape});
  });
  if (damage.warnings.size() == before)
    return true;
  std::erase_if(skinned_, [&](const SkinnedShape& shape) { return shape.node == node; });
  return false;
}

/// Adds the Humanoid of a node with a skin.
void NodeReader::addHumanoid(const SkinnedShape& skinned) {
  const Value skin = document_.array("skins")[skinned.skin], user = document_.array("nodes")[skinned.node];
  const Skin read = readSkin(document_, skinned.skin);
  Humanoid humanoid{{}, read.inverseBindings};
  for (const std::size_t joint : read.joints) {
    const auto found = animatedNodes_.transforms.find(joint);
    if (found == animatedNodes_.transforms.end())
      skin["joints"].fail(ErrorKind::malformed, fmt::format("names node {}, which is not in the scene", joint));
    humanoid.joints.push_back(found->second);
  }
  Node added{skin["name"].text("skin"), std::move(humanoid), {skinned.shape}, ""};
  if (Node& group = scene_.graph.nodes[skinned.shape]; std::holds_alternative<Group>(group.content))
    added.children = group.children;
  if (!user["extensions"]["KHR_node_visibility"]["visible"].boolean(true))
    added.fields = {{"visible", "false"}};
  addRoot(scene_.graph, std::move(added));
}

} // namespace imgeo::gltf
