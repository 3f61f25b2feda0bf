#include "import/gltf/nodes.h"

#include "import/text/rounded_decimal.h"
#include "import/warnings.h"
#include "scene/mf_string.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace imgeo::gltf {

namespace {

constexpr std::size_t maxNodeDepth = 200;
/// The radius of X3D lights that stand for glTF lights of unlimited range.
constexpr double unlimitedRadius = 1e6;

std::string extrasOf(const Value& value) {
  const Value extras = value["extras"];
  return extras.isAbsent() ? "" : extras.json().dump(-1, ' ', false, Json::error_handler_t::replace);
}

Transform transformOfTrs(Vec3d translation, const std::vector<double>& q, Vec3d scale) {
  Transform transform;
  transform.translation = translation;
  transform.rotation = rotationOfQuaternion(q[0], q[1], q[2], q[3]);
  transform.scale = scale;
  return transform;
}

/// A Transform node, or a Group where the transform is the identity.
NodeContent transformOrGroup(Transform transform) {
  transform = rounded(transform);
  return transform == Transform{} ? NodeContent(Group{}) : NodeContent(transform);
}

/// X3D's field of view is that of the shorter side, glTF's the vertical one.
double fieldOfViewOf(const Value& perspective) {
  const double vertical = std::clamp(perspective["yfov"].real(0.7854), 1e-3, std::numbers::pi - 1e-3);
  const double aspect = perspective["aspectRatio"].real(1);
  return aspect > 0 && aspect < 1 ? 2 * std::atan(std::tan(vertical / 2) * aspect) : vertical;
}

} // namespace

template <typename Read> void NodeReader::attempt(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (isStrict_ || error.kind() == ErrorKind::limit)
      throw;
    if (!firstDamage)
      firstDamage = error;
    omissions.damage.push_back(leftOut(error));
  }
}

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
  omissions.otherScenes = std::max<std::size_t>(scenes.size(), 1) - 1;
  if (scenes.size() > 0) {
    const Value scene = scenes[chosen.value_or(0)];
    scene_.graph.title = scene["name"].text();
    addNavigation(scene["extras"]);
    const Value list = scene["nodes"];
    for (std::size_t i = 0; i < list.size(); ++i) {
      const std::uint64_t node = list[i].whole();
      if (node >= nodes.size())
        list[i].fail(ErrorKind::malformed, fmt::format("names node {} of {}", node, nodes.size()));
      roots.push_back(node);
    }
  } else {
    std::vector<bool> isChild(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      for (std::size_t c = 0; c < nodes[i]["children"].size(); ++c)
        if (const std::uint64_t child = nodes[i]["children"][c].whole(); child < nodes.size())
          isChild[child] = true;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (!isChild[i])
        roots.push_back(i);
  }
  addVariantNames();
  for (const std::size_t root : roots)
    if (const std::optional<std::size_t> node = readNode(root, 1, 1))
      scene_.graph.roots.push_back(*node);
  const Value meshes = document_.array("meshes");
  for (std::size_t i = 0; nodes.size() == 0 && i < meshes.size(); ++i)
    if (const std::optional<std::size_t> node = meshNode(i, std::nullopt, 0))
      scene_.graph.roots.push_back(*node);
  addHumanoids();
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
    attempt([&] { value.fail(ErrorKind::malformed, "is the child of two nodes, or of itself"); });
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
    attempt([&] { skin = value.index("skin", document_.array("skins")); });
    if (!skin || !addSkinned(index, *mesh, *skin))
      if (const std::optional<std::size_t> shape = meshNode(*mesh, index, 0))
        addInstances(value, *shape, node.children);
  }
  addCamera(value, node.children);
  addLight(value, scale, node.children);
  const Value children = value["children"];
  for (std::size_t i = 0; i < children.size(); ++i) {
    const std::uint64_t child = children[i].whole();
    if (child >= visited_.size())
      attempt(
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

/// Adds the shape of a node, or its instances by EXT_mesh_gpu_instancing.
void NodeReader::addInstances(const Value& node, std::size_t shape, std::vector<std::size_t>& children) {
  const Value instancing = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  if (instancing.isAbsent()) {
    children.push_back(shape);
    return;
  }
  std::optional<std::size_t> count;
  const auto accessor = [&](const char* name, std::uint32_t components) {
    const std::optional<std::size_t> index = instancing.index(name, document_.array("accessors"));
    std::optional<Accessor> read;
    if (!index)
      return read;
    read = document_.accessor(*index);
    if (read->components() != components || (count && *count != read->count()))
      instancing[name].fail(ErrorKind::malformed, "does not fit the other attributes of the instances");
    count = read->count();
    return read;
  };
  const std::optional<Accessor> translations = accessor("TRANSLATION", 3), rotations = accessor("ROTATION", 4),
                                scales = accessor("SCALE", 3);
  document_.spend(instancing, count.value_or(0) * 512); // the nodes of the instances
  for (std::size_t i = 0; i < count.value_or(0); ++i) {
    const auto number = [&](const std::optional<Accessor>& from, std::uint32_t component, double fallback) {
      const double value = from ? from->real(i, component) : fallback;
      if (!std::isfinite(value))
        instancing.fail(ErrorKind::malformed, fmt::format("the transform of instance {} is not finite", i));
      return value;
    };
    const auto vector = [&](const std::optional<Accessor>& from, double fallback) {
      return Vec3d{number(from, 0, fallback), number(from, 1, fallback), number(from, 2, fallback)};
    };
    const Transform transform = transformOfTrs(
        vector(translations, 0),
        {number(rotations, 0, 0), number(rotations, 1, 0), number(rotations, 2, 0), number(rotations, 3, 1)},
        vector(scales, 1));
    children.push_back(addNode(scene_.graph, {"", transformOrGroup(transform), {shape}, ""}));
  }
}

std::optional<std::size_t> NodeReader::meshNode(std::size_t index, std::optional<std::size_t> user,
                                                std::size_t jointCount) {
  if (jointCount > 0 || targetCountOf(index) > 0)
    return newMeshNode(index, user, jointCount);
  const auto found = meshNodes_.find(index);
  return found != meshNodes_.end() ? found->second : meshNodes_[index] = newMeshNode(index, user, 0);
}

std::optional<std::size_t> NodeReader::newMeshNode(std::size_t index, std::optional<std::size_t> user,
                                                   std::size_t jointCount) {
  const Value value = document_.array("meshes")[index], primitives = value["primitives"];
  const std::string nodeName = user ? document_.array("nodes")[*user]["name"].text() : "";
  const std::string meshName = value["name"].text(), name = meshName == nodeName ? "" : meshName;
  const std::vector<std::size_t> displacers = displacerNodes(index, user);
  std::vector<std::size_t> shapes;
  for (std::size_t i = 0; i < primitives.size(); ++i)
    attempt([&] {
      shapes.push_back(shapeNode(primitives[i], primitives.size() == 1 ? name : "", jointCount, displacers));
    });
  if (primitives.size() == 1 && !shapes.empty())
    return shapes[0];
  if (shapes.empty())
    return {};
  return addNode(scene_.graph, {name, Group{}, std::move(shapes), ""});
}

/// The morph targets of a mesh: all its primitives have as many.
std::size_t NodeReader::targetCountOf(std::size_t mesh) const {
  const Value primitives = document_.array("meshes")[mesh]["primitives"];
  return primitives.size() > 0 ? primitives[std::size_t{0}]["targets"].size() : 0;
}

/// Adds the displacers of a mesh with morph targets, which all its shapes share.
std::vector<std::size_t> NodeReader::displacerNodes(std::size_t mesh, std::optional<std::size_t> user) {
  const Value value = document_.array("meshes")[mesh];
  std::vector<Displacer> displacers(std::min(targetCountOf(mesh), maxDisplacers));
  const Json none;
  const Value node = user ? document_.array("nodes")[*user] : Value(none, "");
  attempt([&] { displacers = displacersOf(node, value, displacers.size()); });
  std::vector<std::size_t> nodes;
  for (Displacer& displacer : displacers) {
    const std::string name = displacer.name.empty() ? fmt::format("displacer{}", nodes.size()) : displacer.name;
    nodes.push_back(addNode(scene_.graph, {name, std::move(displacer), {}, ""}));
  }
  if (user && !nodes.empty())
    animatedNodes_.displacers[*user] = nodes;
  return nodes;
}

/// Adds the shapes of a node with a skin. They belong to no node of the document: glTF ignores the node's transform.
/// Returns false, with a warning, where the skin or its vertices are damaged: the mesh is then drawn as it was
/// modelled.
bool NodeReader::addSkinned(std::size_t node, std::size_t mesh, std::size_t skin) {
  const std::size_t before = omissions.damage.size();
  attempt([&] {
    const std::size_t jointCount = readSkin(document_, skin).joints.size();
    if (const std::optional<std::size_t> shape = meshNode(mesh, node, jointCount))
      skinned_.push_back({node, skin, *shape});
  });
  if (omissions.damage.size() == before)
    return true;
  std::erase_if(skinned_, [&](const SkinnedShape& shape) { return shape.node == node; });
  return false;
}

/// Adds a Humanoid for each node with a skin, behind all joints: documents define a node before they USE it.
void NodeReader::addHumanoids() {
  for (const auto& [node, skin, shape] : skinned_)
    attempt([&] {
      const Value value = document_.array("skins")[skin], user = document_.array("nodes")[node];
      const Skin read = readSkin(document_, skin);
      Humanoid humanoid{{}, read.inverseBindings};
      for (const std::size_t joint : read.joints) {
        const auto found = animatedNodes_.transforms.find(joint);
        if (found == animatedNodes_.transforms.end())
          value["joints"].fail(ErrorKind::malformed, fmt::format("names node {}, which is not in the scene", joint));
        humanoid.joints.push_back(found->second);
      }
      Node added{value["name"].text("skin"), std::move(humanoid), {shape}, ""};
      if (Node& group = scene_.graph.nodes[shape]; std::holds_alternative<Group>(group.content))
        added.children = group.children;
      if (!user["extensions"]["KHR_node_visibility"]["visible"].boolean(true))
        added.fields = {{"visible", "false"}};
      addRoot(scene_.graph, std::move(added));
    });
}

std::size_t NodeReader::shapeNode(const Value& primitive, const std::string& name, std::size_t jointCount,
                                  const std::vector<std::size_t>& displacers) {
  Shape shape;
  const std::optional<std::size_t> material = primitive.index("material", document_.array("materials"));
  const Value mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
  shape.mesh = meshOf(primitive, texCoordSetsOf(material, mappings), jointCount);
  std::vector<std::size_t> own = displacers;
  own.resize(std::min(own.size(), displacementCount(scene_.meshes[shape.mesh])));
  if (mappings.size() > 0)
    return variantsNode(shape, material, mappings, name, own);
  return addNode(scene_.graph, {name, withMaterial(shape, material), std::move(own), ""});
}

/// The sets of texture coordinates that a primitive's material uses, or its material in any variant.
std::set<std::size_t> NodeReader::texCoordSetsOf(std::optional<std::size_t> material, const Value& mappings) {
  std::set<std::size_t> sets;
  const auto add = [&](std::optional<std::size_t> of) {
    if (of)
      attempt([&] { sets.insert(materials_.texCoordSets(*of).begin(), materials_.texCoordSets(*of).end()); });
  };
  add(material);
  for (std::size_t i = 0; i < mappings.size(); ++i)
    add(mappings[i].index("material", document_.array("materials")));
  return sets;
}

Shape NodeReader::withMaterial(Shape shape, std::optional<std::size_t> material) {
  if (material)
    attempt([&] {
      shape.appearance = materials_.appearance(*material);
      shape.solid = materials_.isSolid(*material);
    });
  return shape;
}

/// KHR_materials_variants: a Switch whose first child is the shape with the primitive's own material, and whose child
/// i + 1 is the shape with its material in variant i. Children with the same material are one node.
std::size_t NodeReader::variantsNode(const Shape& shape, std::optional<std::size_t> material, const Value& mappings,
                                     const std::string& name, const std::vector<std::size_t>& displacers) {
  const Value names = document_.root()["extensions"]["KHR_materials_variants"]["variants"],
              materials = document_.array("materials");
  std::vector<std::optional<std::size_t>> materialOf(names.size() + 1, material);
  for (std::size_t i = 0; i < mappings.size(); ++i)
    for (std::size_t v = 0; v < mappings[i]["variants"].size(); ++v) {
      const std::uint64_t variant = mappings[i]["variants"][v].whole();
      if (variant >= names.size())
        mappings[i]["variants"].fail(ErrorKind::malformed,
                                     fmt::format("names variant {} of {}", variant, names.size()));
      materialOf[variant + 1] = mappings[i].index("material", materials);
    }
  document_.spend(mappings, materialOf.size() * 256); // the nodes
  Node node{name, GenericNode{"Switch", "", {}}, {}, "", {{"whichChoice", "0"}, {"class", "variants"}}};
  std::map<std::optional<std::size_t>, std::size_t> shapes;
  for (std::size_t i = 0; i < materialOf.size(); ++i) {
    const auto [found, isNew] = shapes.try_emplace(materialOf[i]);
    if (isNew)
      found->second = addNode(scene_.graph, {i == 0 ? "" : names[i - 1]["name"].text(),
                                             withMaterial(shape, materialOf[i]), displacers, ""});
    node.children.push_back(found->second);
  }
  return addNode(scene_.graph, std::move(node));
}

/// The mesh of a primitive whose textures use these sets of texture coordinates; primitives that otherwise differ only
/// in material and extras share one.
std::size_t NodeReader::meshOf(const Value& primitive, const std::set<std::size_t>& texCoordSets,
                               std::size_t jointCount) {
  Json key = primitive.json();
  if (!key.is_object())
    primitive.fail(ErrorKind::malformed, "is no object");
  key.erase("material");
  key.erase("extras");
  const std::set<std::size_t>& sets = texCoordSets.empty() ? std::set<std::size_t>{0} : texCoordSets;
  const std::string text = fmt::format("{} {} {}", key.dump(-1, ' ', false, Json::error_handler_t::replace),
                                       fmt::join(sets, " "), jointCount);
  if (const auto found = meshes_.find(text); found != meshes_.end())
    return found->second;
  scene_.meshes.push_back(primitives_.read(primitive, texCoordSets, jointCount));
  return meshes_[text] = scene_.meshes.size() - 1;
}

void NodeReader::addCamera(const Value& node, std::vector<std::size_t>& children) {
  const std::optional<std::size_t> index = node.index("camera", document_.array("cameras"));
  if (!index)
    return;
  const Value camera = document_.array("cameras")[*index];
  const std::string description = camera["name"].text(node["name"].text());
  if (camera.has("orthographic")) {
    OrthoViewpoint viewpoint;
    viewpoint.description = description;
    viewpoint.position = {};
    const double x = camera["orthographic"]["xmag"].real(1), y = camera["orthographic"]["ymag"].real(1);
    viewpoint.min = {-x, -y};
    viewpoint.max = {x, y};
    children.push_back(addNode(scene_.graph, {"", viewpoint, {}, extrasOf(camera)}));
  } else {
    Viewpoint viewpoint;
    viewpoint.description = description;
    viewpoint.position = {};
    viewpoint.fieldOfView = fieldOfViewOf(camera["perspective"]);
    children.push_back(addNode(scene_.graph, {"", viewpoint, {}, extrasOf(camera)}));
  }
}

/// KHR_lights_punctual: photometric units, falling off with the square of the distance. Range and falloff are measured
/// in scene units in glTF, in the node's coordinate system in X3D.
void NodeReader::addLight(const Value& node, double scale, std::vector<std::size_t>& children) {
  const Value lights = document_.root()["extensions"]["KHR_lights_punctual"]["lights"];
  const std::optional<std::size_t> index = node["extensions"]["KHR_lights_punctual"].index("light", lights);
  if (!index)
    return;
  const Value light = lights[*index];
  const Vec3f color = light["color"].vec3f({1, 1, 1});
  const auto intensity = static_cast<float>(light["intensity"].real(1));
  const double range = light["range"].real(0), unit = scale > 0 && std::isfinite(scale) ? scale : 1,
               radius = (range > 0 ? range : unlimitedRadius) / unit;
  const Vec3d bySquare{0, 0, unit * unit};
  const std::string type = light["type"].text();
  NodeContent content;
  if (type == "directional") {
    content = DirectionalLight{{0, 0, -1}, color, intensity, true};
  } else if (type == "point") {
    content = PointLight{{}, bySquare, radius, color, intensity, true};
  } else if (type == "spot") {
    const double inner = light["spot"]["innerConeAngle"].real(0),
                 outer = light["spot"]["outerConeAngle"].real(std::numbers::pi / 4);
    content = SpotLight{{}, {0, 0, -1}, inner, outer, bySquare, radius, color, intensity, true};
  } else {
    return attempt([&] { light["type"].fail(ErrorKind::unsupported, "is no light that X3D has"); });
  }
  children.push_back(addNode(scene_.graph, {light["name"].text(), content, {}, extrasOf(light)}));
}

} // namespace imgeo::gltf
