// Binary glTF 2.0 (Khronos Group, "glTF 2.0 Specification", sections 3.6 and 4).

#include "base/error.h"
#include "base/narrow.h"
#include "export/export.h"
#include "export/gltf_animations.h"
#include "export/gltf_arrays.h"
#include "export/gltf_deformation.h"
#include "export/gltf_light.h"
#include "export/gltf_material.h"
#include "scene/mf_string.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <tuple>

namespace imgeo {

namespace {

constexpr std::uint32_t jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942, magic = 0x46546c67;

/// Collects the top-level arrays of a glTF file. The arrays of a mesh are written once, even if several shapes use it
/// with several materials.
class GltfBuilder {
public:
  explicit GltfBuilder(const Scene& scene)
      : scene_(scene), primitives_(scene.meshes.size()), animatedNodes_(gltfAnimatedNodes(scene.graph)) {
    shapeInstances(scene.graph); // throws if there are too many instances: glTF nodes have one parent
    for (const std::size_t root : scene.graph.roots)
      if (const std::optional<std::size_t> node = addNode(root))
        roots.push_back(*node);
    addSkins();
    animations = gltfAnimations(scene, {gltfNodes_, shapeNodes_}, arrays);
  }

  GltfArrays arrays;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), roots = Json::array();
  Json images = Json::array(), samplers = Json::array(), textures = Json::array(), cameras = Json::array();
  Json lights = Json::array(), animations = Json::array(), skins = Json::array();

private:
  /// Adds a node and its descendants. Returns its index; nothing if there is no shape, viewpoint or light among them.
  std::optional<std::size_t> addNode(std::size_t index) {
    const Node& node = scene_.graph.nodes[index];
    if (animatedNodes_.contains(index))
      return addAnimatedNode(index);
    if (std::holds_alternative<Displacer>(node.content))
      return {};
    Json json = Json::object();
    std::optional<std::size_t> shapeIndex;
    if (!node.name.empty())
      json["name"] = node.name;
    if (std::holds_alternative<Shape>(node.content)) {
      json["mesh"] = meshIndexOf(index);
      shapeIndex = index;
    } else if (const Node* onlyShape = onlyShapeOf(node)) {
      json["mesh"] = meshIndexOf(node.children[0]);
      shapeIndex = node.children[0];
      if (node.name.empty() && !onlyShape->name.empty())
        json["name"] = onlyShape->name;
      if (const Transform* transform = std::get_if<Transform>(&node.content))
        addTransform(json, *transform);
    } else if (const Viewpoint* viewpoint = std::get_if<Viewpoint>(&node.content)) {
      addCamera(json, *viewpoint);
    } else if (const std::optional<GltfLight> light = gltfLight(node.content)) {
      addMatrix(json, light->nodeFromLight);
      json["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      lights.push_back(light->json);
    } else {
      const std::size_t firstShape = shapesInOrder_.size();
      Json children = addChildren(node);
      if (children.empty() && !isJoint(node))
        return {};
      if (std::holds_alternative<Humanoid>(node.content))
        skinned_.push_back(
            {index, {shapesInOrder_.begin() + static_cast<std::ptrdiff_t>(firstShape), shapesInOrder_.end()}});
      if (!children.empty())
        json["children"] = std::move(children);
      if (const Transform* transform = std::get_if<Transform>(&node.content))
        addTransform(json, *transform);
    }
    if (shapeIndex)
      addWeights(json, *shapeIndex);
    nodes.push_back(std::move(json));
    if (isJoint(node))
      gltfNodes_[index].push_back(nodes.size() - 1);
    if (shapeIndex) {
      shapeNodes_[*shapeIndex].push_back(nodes.size() - 1);
      shapesInOrder_.push_back(nodes.size() - 1);
    }
    return nodes.size() - 1;
  }

  static bool isJoint(const Node& node) {
    const Transform* transform = std::get_if<Transform>(&node.content);
    return transform && transform->isJoint;
  }

  /// The weights of a shape's morph targets.
  void addWeights(Json& json, std::size_t shapeIndex) const {
    for (const std::size_t displacer : displacersOf(scene_, shapeIndex))
      json["weights"].push_back(std::get<Displacer>(scene_.graph.nodes[displacer].content).weight);
  }

  /// Adds the skins of the humanoids, when all joints have their nodes.
  void addSkins() {
    for (const auto& [humanoid, shapes] : skinned_) {
      const Node& node = scene_.graph.nodes[humanoid];
      Json skin = gltfSkin(arrays, std::get<Humanoid>(node.content), gltfNodes_);
      if (skin.is_null())
        continue;
      skins.push_back(std::move(skin));
      if (!node.name.empty())
        skins.back()["name"] = node.name;
      for (const std::size_t shape : shapes)
        nodes[shape]["skin"] = skins.size() - 1;
    }
  }

  /// Adds the children of a node; returns their indices.
  Json addChildren(const Node& node) {
    Json children = Json::array();
    for (const std::size_t child : node.children)
      if (const std::optional<std::size_t> added = addNode(child))
        children.push_back(*added);
    return children;
  }

  /// Adds a Transform that an animation moves, as translation, rotation and scale about its center.
  std::optional<std::size_t> addAnimatedNode(std::size_t index) {
    const Node& node = scene_.graph.nodes[index];
    const Transform& transform = std::get<Transform>(node.content);
    Json children = addChildren(node);
    if (children.empty() && !transform.isJoint)
      return {};
    const auto vector = [](Vec3d v) { return Json{v.x, v.y, v.z}; };
    if (transform.center != Vec3d{} && !children.empty()) {
      nodes.push_back({{"translation", vector(transform.center * -1)}, {"children", std::move(children)}});
      children = Json::array({nodes.size() - 1});
    }
    Json json{{"translation", vector(transform.translation + transform.center)},
              {"rotation", quaternionOf(transform.rotation)},
              {"scale", vector(transform.scale)}};
    if (!children.empty())
      json["children"] = std::move(children);
    if (!node.name.empty())
      json["name"] = node.name;
    nodes.push_back(std::move(json));
    gltfNodes_[index].push_back(nodes.size() - 1);
    return nodes.size() - 1;
  }

  /// The shape that is the only child of a Group or Transform: both become one glTF node, unless both have names.
  const Node* onlyShapeOf(const Node& node) const {
    if (node.children.size() != 1 ||
        !(std::holds_alternative<Transform>(node.content) || std::holds_alternative<Group>(node.content)))
      return nullptr;
    const Node& child = scene_.graph.nodes[node.children[0]];
    if (isJoint(node))
      return nullptr;
    const bool haveBothNames = !node.name.empty() && !child.name.empty();
    return std::holds_alternative<Shape>(child.content) && !haveBothNames ? &child : nullptr;
  }

  /// Adds a camera. Cameras of glTF look along -z of their node, as X3D viewpoints do.
  void addCamera(Json& json, const Viewpoint& viewpoint) {
    Transform pose;
    pose.translation = viewpoint.position;
    pose.rotation = viewpoint.orientation;
    addTransform(json, pose);
    json["camera"] = cameras.size();
    Json camera{{"type", "perspective"}, {"perspective", {{"yfov", viewpoint.fieldOfView}, {"znear", 0.01}}}};
    if (!viewpoint.description.empty())
      camera["name"] = viewpoint.description;
    cameras.push_back(std::move(camera));
  }

  static void addTransform(Json& json, const Transform& transform) { addMatrix(json, affineOf(transform)); }

  static void addMatrix(Json& json, const Affine3d& map) {
    if (map == Affine3d{})
      return;
    Json matrix = Json::array();
    for (const Vec3d& column : {map.x, map.y, map.z, map.translation}) {
      for (int axis = 0; axis < 3; ++axis)
        matrix.push_back(column[axis]);
      matrix.push_back(matrix.size() == 15 ? 1 : 0);
    }
    json["matrix"] = std::move(matrix);
  }

  std::size_t meshIndexOf(std::size_t shapeIndex) {
    const Shape& shape = std::get<Shape>(scene_.graph.nodes[shapeIndex].content);
    const std::string& name = scene_.graph.nodes[shapeIndex].name;
    std::vector<std::string> targetNames;
    for (const std::size_t displacer : displacersOf(scene_, shapeIndex))
      targetNames.push_back(std::get<Displacer>(scene_.graph.nodes[displacer].content).name);
    const auto [found, isNew] =
        meshIndices_.try_emplace({shape.mesh, shape.appearance, shape.solid, targetNames}, meshes.size());
    if (!isNew)
      return found->second;
    const Mesh& mesh = scene_.meshes.at(shape.mesh);
    Json& primitive = primitives_[shape.mesh];
    if (primitive.is_null())
      primitive = gltfPrimitive(arrays, mesh);
    Json withMaterial = primitive;
    withMaterial["material"] = materialIndexOf(shape, mesh);
    Json json{{"primitives", Json::array({std::move(withMaterial)})}};
    for (const std::string& target : targetNames)
      json["extras"]["targetNames"].push_back(target);
    if (!name.empty())
      json["name"] = name;
    meshes.push_back(std::move(json));
    return found->second;
  }

  std::size_t materialIndexOf(const Shape& shape, const Mesh& mesh) {
    static const Appearance defaultAppearance;
    const Appearance& appearance =
        shape.appearance ? scene_.graph.appearances.at(*shape.appearance) : defaultAppearance;
    Json json = gltfMaterial(appearance, shape, mesh, [&](std::size_t texture) { return textureIndexOf(texture); });
    const auto [found, isNew] =
        materialIndices_.try_emplace(json.dump(-1, ' ', false, replaceBadUtf8), materials.size());
    if (isNew)
      materials.push_back(std::move(json));
    return found->second;
  }

  std::optional<std::size_t> textureIndexOf(std::size_t index) {
    if (const auto found = textureIndices_.find(index); found != textureIndices_.end())
      return found->second;
    const Texture& texture = scene_.graph.textures.at(index);
    const ImageFile& image = scene_.graph.images.at(texture.image);
    std::optional<std::size_t>& gltfIndex = textureIndices_[index];
    const std::string_view signature = asText(image.bytes);
    const char* type = signature.starts_with("\x89PNG")        ? "image/png"
                       : signature.starts_with("\xff\xd8\xff") ? "image/jpeg"
                       : signature.starts_with("RIFF")         ? "image/webp"
                                                               : nullptr;
    if (!type)
      return gltfIndex;
    const auto [imageIndex, isNew] = imageIndices_.try_emplace(texture.image, images.size());
    if (isNew)
      images.push_back({{"bufferView", arrays.addFile(image.bytes)}, {"mimeType", type}});
    samplers.push_back(gltfSampler(texture));
    textures.push_back({{"sampler", samplers.size() - 1}});
    if (type == std::string_view("image/webp"))
      textures.back()["extensions"]["EXT_texture_webp"]["source"] = imageIndex->second;
    else
      textures.back()["source"] = imageIndex->second;
    if (!texture.name.empty())
      textures.back()["name"] = texture.name;
    gltfIndex = textures.size() - 1;
    return gltfIndex;
  }

  static constexpr auto replaceBadUtf8 = Json::error_handler_t::replace;

  const Scene& scene_;
  std::vector<Json> primitives_; ///< by index of the mesh
  std::map<std::tuple<std::size_t, std::optional<std::size_t>, bool, std::vector<std::string>>, std::size_t>
      meshIndices_;                                    ///< by mesh, appearance, solid and the names of morph targets
  std::map<std::string, std::size_t> materialIndices_; ///< by the JSON text
  std::map<std::size_t, std::optional<std::size_t>> textureIndices_; ///< nothing for images of other formats
  std::map<std::size_t, std::size_t> imageIndices_;
  std::set<std::size_t> animatedNodes_;
  std::map<std::size_t, std::vector<std::size_t>> gltfNodes_, shapeNodes_; ///< of animated nodes and joints; of shapes
  std::vector<std::size_t> shapesInOrder_;                                 ///< nodes of the file with a mesh
  struct Skinned {
    std::size_t humanoid;
    std::vector<std::size_t> shapes; ///< nodes of the file
  };
  std::vector<Skinned> skinned_;
};

void appendChunk(Bytes& glb, std::uint32_t type, ByteSpan data, std::uint8_t padding) {
  const std::size_t paddedSize = (data.size() + 3) / 4 * 4;
  appendLittle(glb, narrow<std::uint32_t>(paddedSize));
  appendLittle(glb, type);
  glb.insert(glb.end(), data.begin(), data.end());
  glb.resize(glb.size() + paddedSize - data.size(), padding);
}

/// The `type` field of the first NavigationInfo that has it. glTF has no such property, so it is written as extras.
std::vector<std::string> navigationTypes(const SceneGraph& graph) {
  for (const std::size_t index : nodesInOrder(graph)) {
    const Node& node = graph.nodes[index];
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    const auto type = std::ranges::find(node.fields, "type", &FieldText::name);
    if (generic && generic->element == "NavigationInfo" && type != node.fields.end())
      return parseStrings(type->value);
  }
  return {};
}

} // namespace

Bytes writeGlb(const Scene& scene) {
  const GltfBuilder gltf(scene);
  const GltfArrays& arrays = gltf.arrays;
  Json root{{"asset", {{"version", "2.0"}, {"generator", "imgeo"}}}};
  const std::string materialText =
      Json{gltf.materials, gltf.textures}.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (const char* extension :
       {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp", "KHR_materials_anisotropy",
        "KHR_materials_clearcoat", "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
        "KHR_materials_iridescence", "KHR_materials_sheen", "KHR_materials_specular", "KHR_materials_transmission",
        "KHR_materials_volume"})
    if (materialText.find(extension) != materialText.npos)
      root["extensionsUsed"].push_back(extension);
  root["scene"] = 0;
  root["scenes"] = Json::array({{{"nodes", gltf.roots}}});
  if (const std::vector<std::string> types = navigationTypes(scene.graph); !types.empty())
    root["scenes"][0]["extras"]["NavigationInfo"]["type"] = types;
  root["nodes"] = gltf.nodes;
  root["meshes"] = gltf.meshes;
  root["materials"] = gltf.materials;
  if (!gltf.textures.empty()) {
    root["textures"] = gltf.textures;
    root["images"] = gltf.images;
    root["samplers"] = gltf.samplers;
  }
  if (!gltf.cameras.empty())
    root["cameras"] = gltf.cameras;
  if (!gltf.lights.empty()) {
    root["extensionsUsed"].push_back("KHR_lights_punctual");
    root["extensions"]["KHR_lights_punctual"]["lights"] = gltf.lights;
  }
  if (!gltf.skins.empty())
    root["skins"] = gltf.skins;
  if (!gltf.animations.empty())
    root["animations"] = gltf.animations;
  root["accessors"] = arrays.accessors;
  root["bufferViews"] = arrays.views;
  root["buffers"] = Json::array({{{"byteLength", arrays.bytes.size()}}});
  const std::string json = root.dump(-1, ' ', false, Json::error_handler_t::replace);

  const std::uint64_t length = 12 + 8 + (json.size() + 3) / 4 * 4 + 8 + arrays.bytes.size();
  if (length > UINT32_MAX)
    throw Error(ErrorKind::limit, "", "the scene is larger than the 4 GiB that a GLB file can hold");
  Bytes glb;
  glb.reserve(length);
  for (const std::uint32_t word : {magic, std::uint32_t{2}, static_cast<std::uint32_t>(length)})
    appendLittle(glb, word);
  appendChunk(glb, jsonChunk, asBytes(json), ' ');
  appendChunk(glb, binaryChunk, arrays.bytes, 0);
  return glb;
}

} // namespace imgeo
