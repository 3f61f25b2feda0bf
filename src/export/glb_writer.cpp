// Binary glTF 2.0 (Khronos Group, "glTF 2.0 Specification", sections 3.6 and 4).

#include "base/error.h"
#include "base/narrow.h"
#include "export/export.h"
#include "export/gltf_material.h"
#include "scene/color.h"
#include "scene/mf_string.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>

namespace imgeo {

namespace {

// The names that the specification gives its constants.
constexpr int arrayBuffer = 34962, elementArrayBuffer = 34963;
constexpr int unsignedShort = 5123, unsignedInt = 5125, floatType = 5126;
constexpr std::uint32_t jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942, magic = 0x46546c67;

/// The binary chunk, and the views and accessors that say what lies where in it.
class Arrays {
public:
  Bytes bytes;
  Json views = Json::array(), accessors = Json::array();

  /// To be called before the bytes of an array are appended.
  void begin() { first_ = bytes.size(); }

  /// Describes what has been appended since begin(); returns the accessor's number.
  std::size_t end(int target, int componentType, const char* type, std::size_t count) {
    views.push_back({{"buffer", 0}, {"byteOffset", first_}, {"byteLength", bytes.size() - first_}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
    bytes.resize((bytes.size() + 3) / 4 * 4); // arrays begin at whole words
    return accessors.size() - 1;
  }

  /// Adds a file; returns the number of its view.
  std::size_t addBytes(const Bytes& file) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", file.size()}});
    bytes.insert(bytes.end(), file.begin(), file.end());
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return views.size() - 1;
  }

private:
  std::size_t first_ = 0;
};

std::size_t addPositions(Arrays& arrays, const Mesh& mesh) {
  Vec3f min = mesh.positions[mesh.wedgePositions[0]], max = min;
  arrays.begin();
  for (const std::uint32_t position : mesh.wedgePositions)
    for (int axis = 0; axis < 3; ++axis) {
      const float value = mesh.positions[position][axis];
      min[axis] = std::min(min[axis], value);
      max[axis] = std::max(max[axis], value);
      appendLittle(arrays.bytes, value);
    }
  const std::size_t accessor = arrays.end(arrayBuffer, floatType, "VEC3", mesh.wedgeCount());
  arrays.accessors.back()["min"] = {min.x, min.y, min.z};
  arrays.accessors.back()["max"] = {max.x, max.y, max.z};
  return accessor;
}

std::size_t addNormals(Arrays& arrays, const Mesh& mesh) {
  arrays.begin();
  for (const Vec3f& normal : mesh.normals)
    for (int axis = 0; axis < 3; ++axis)
      appendLittle(arrays.bytes, normal[axis]);
  return arrays.end(arrayBuffer, floatType, "VEC3", mesh.wedgeCount());
}

std::size_t addTexCoords(Arrays& arrays, const Mesh& mesh) {
  arrays.begin();
  for (const Vec2f& texCoord : mesh.texCoords) {
    appendLittle(arrays.bytes, texCoord.x);
    appendLittle(arrays.bytes, 1 - texCoord.y);
  }
  return arrays.end(arrayBuffer, floatType, "VEC2", mesh.wedgeCount());
}

std::size_t addColors(Arrays& arrays, const Mesh& mesh) {
  std::array<std::uint16_t, 256> linearOf;
  for (std::size_t i = 0; i < 256; ++i)
    linearOf[i] = static_cast<std::uint16_t>(std::lround(65535 * linearOfSrgb(static_cast<double>(i) / 255)));
  arrays.begin();
  for (const Rgba8& color : mesh.colors) {
    for (const std::uint8_t channel : {color.r, color.g, color.b})
      appendLittle(arrays.bytes, linearOf[channel]);
    appendLittle(arrays.bytes, static_cast<std::uint16_t>(257 * color.a)); // alpha is linear as it is
  }
  const std::size_t accessor = arrays.end(arrayBuffer, unsignedShort, "VEC4", mesh.wedgeCount());
  arrays.accessors.back()["normalized"] = true;
  return accessor;
}

std::size_t addNamed(Arrays& arrays, const NamedAttribute& attribute) {
  constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  arrays.begin();
  for (const float value : attribute.values)
    appendLittle(arrays.bytes, value);
  return arrays.end(arrayBuffer, floatType, types[attribute.components - 1], attribute.count());
}

/// 65,535 itself is no index: it restarts primitives.
std::size_t addIndices(Arrays& arrays, const Mesh& mesh) {
  const bool shorts = mesh.wedgeCount() <= 65535;
  arrays.begin();
  for (const std::uint32_t corner : mesh.corners) {
    if (shorts)
      appendLittle(arrays.bytes, static_cast<std::uint16_t>(corner));
    else
      appendLittle(arrays.bytes, corner);
  }
  return arrays.end(elementArrayBuffer, shorts ? unsignedShort : unsignedInt, "SCALAR", mesh.corners.size());
}

/// Everything of a primitive but its material.
Json primitiveOf(Arrays& arrays, const Mesh& mesh) {
  Json attributes{{"POSITION", addPositions(arrays, mesh)}};
  if (!mesh.normals.empty())
    attributes["NORMAL"] = addNormals(arrays, mesh);
  if (!mesh.texCoords.empty())
    attributes["TEXCOORD_0"] = addTexCoords(arrays, mesh);
  if (!mesh.colors.empty())
    attributes["COLOR_0"] = addColors(arrays, mesh);
  for (const NamedAttribute& attribute : mesh.namedAttributes)
    attributes["_" + attribute.name] = addNamed(arrays, attribute);
  constexpr int modes[] = {0, 1, 4}; // POINTS, LINES, TRIANGLES
  return {{"attributes", attributes},
          {"indices", addIndices(arrays, mesh)},
          {"mode", modes[cornersPerElement(mesh.topology) - 1]}};
}

/// A map that turns -z to a direction and moves the origin.
Affine3d facing(Vec3d direction, Vec3d origin) {
  const double size = length(direction);
  if (size == 0)
    return {.translation = origin};
  const Vec3d z = direction * (-1 / size), aside = cross(std::abs(z.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0}, z);
  const Vec3d x = aside * (1 / length(aside));
  return {x, cross(z, x), z, origin};
}

struct PlacedLight {
  Json json; ///< of KHR_lights_punctual
  Affine3d place;
};

/// What glTF can say of a light: it shines on everything and, but for a directional
/// one, falls off by the square of the distance.
std::optional<PlacedLight> lightOf(const NodeContent& content) {
  const auto common = [](const char* type, const auto& light) {
    return Json{
        {"type", type}, {"color", {light.color.x, light.color.y, light.color.z}}, {"intensity", light.intensity}};
  };
  const auto placed = [&](const char* type, const auto& light) {
    Json json = common(type, light);
    json["range"] = light.radius;
    return json;
  };
  const auto isOfGltf = [](const auto& light) {
    return light.global && light.attenuation == Vec3d{0, 0, 1} && light.radius > 0;
  };
  if (const auto* sun = std::get_if<DirectionalLight>(&content); sun && sun->global)
    return PlacedLight{common("directional", *sun), facing(sun->direction, {})};
  if (const auto* lamp = std::get_if<PointLight>(&content); lamp && isOfGltf(*lamp))
    return PlacedLight{placed("point", *lamp), {.translation = lamp->location}};
  if (const auto* spot = std::get_if<SpotLight>(&content); spot && isOfGltf(*spot)) {
    Json json = placed("spot", *spot);
    const double outer = std::min(spot->cutOffAngle, std::numbers::pi / 2);
    // The inner angle has to be the smaller one.
    json["spot"] = {{"innerConeAngle", std::min(spot->beamWidth, outer * 0.999)}, {"outerConeAngle", outer}};
    return PlacedLight{std::move(json), facing(spot->direction, spot->location)};
  }
  return {};
}

/// Collects the lists of a glTF file. A mesh's arrays are written once, however
/// many shapes show it in whatever materials.
class GltfBuilder {
public:
  explicit GltfBuilder(const Scene& scene) : scene_(scene), primitives_(scene.meshes.size()) {
    shapeInstances(scene.graph); // refuses more than can be listed: glTF knows no node in two places
    for (const std::size_t root : scene.graph.roots)
      if (const std::optional<std::size_t> node = addNode(root))
        roots.push_back(*node);
  }

  Arrays arrays;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), roots = Json::array();
  Json images = Json::array(), samplers = Json::array(), textures = Json::array(), cameras = Json::array();
  Json lights = Json::array();

private:
  /// The glTF node of a viewpoint, of a light, or of a node below which something is seen.
  std::optional<std::size_t> addNode(std::size_t index) {
    const Node& node = scene_.graph.nodes[index];
    Json json = Json::object();
    if (!node.name.empty())
      json["name"] = node.name;
    if (const Shape* shape = std::get_if<Shape>(&node.content)) {
      json["mesh"] = meshOf(*shape, node.name);
    } else if (const Node* placed = onlyShapeOf(node)) {
      json["mesh"] = meshOf(std::get<Shape>(placed->content), placed->name);
      if (node.name.empty() && !placed->name.empty())
        json["name"] = placed->name;
      if (const Transform* transform = std::get_if<Transform>(&node.content))
        addTransform(json, *transform);
    } else if (const Viewpoint* viewpoint = std::get_if<Viewpoint>(&node.content)) {
      addCamera(json, *viewpoint);
    } else if (const std::optional<PlacedLight> light = lightOf(node.content)) {
      addMatrix(json, light->place);
      json["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
      lights.push_back(light->json);
    } else {
      Json children = Json::array();
      for (const std::size_t child : node.children)
        if (const std::optional<std::size_t> added = addNode(child))
          children.push_back(*added);
      if (children.empty())
        return {};
      json["children"] = std::move(children);
      if (const Transform* transform = std::get_if<Transform>(&node.content))
        addTransform(json, *transform);
    }
    nodes.push_back(std::move(json));
    return nodes.size() - 1;
  }

  /// The shape that is all there is in a Group or Transform: glTF has one node for the
  /// two, unless each has a name.
  const Node* onlyShapeOf(const Node& node) const {
    if (node.children.size() != 1 ||
        !(std::holds_alternative<Transform>(node.content) || std::holds_alternative<Group>(node.content)))
      return nullptr;
    const Node& child = scene_.graph.nodes[node.children[0]];
    const bool haveBothNames = !node.name.empty() && !child.name.empty();
    return std::holds_alternative<Shape>(child.content) && !haveBothNames ? &child : nullptr;
  }

  /// glTF's camera looks along -z of its node, as X3D's viewpoint does.
  void addCamera(Json& json, const Viewpoint& viewpoint) {
    Transform place;
    place.translation = viewpoint.position;
    place.rotation = viewpoint.orientation;
    addTransform(json, place);
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

  std::size_t meshOf(const Shape& shape, const std::string& name) {
    const auto [found, isNew] = meshOf_.try_emplace({shape.mesh, shape.appearance, shape.solid}, meshes.size());
    if (!isNew)
      return found->second;
    const Mesh& mesh = scene_.meshes.at(shape.mesh);
    Json& primitive = primitives_[shape.mesh];
    if (primitive.is_null())
      primitive = primitiveOf(arrays, mesh);
    Json withMaterial = primitive;
    withMaterial["material"] = materialIndexOf(shape, mesh);
    Json json{{"primitives", Json::array({std::move(withMaterial)})}};
    if (!name.empty())
      json["name"] = name;
    meshes.push_back(std::move(json));
    return found->second;
  }

  std::size_t materialIndexOf(const Shape& shape, const Mesh& mesh) {
    static const Appearance plain;
    const Appearance& appearance = shape.appearance ? scene_.graph.appearances.at(*shape.appearance) : plain;
    Json json = gltfMaterial(appearance, shape, mesh, [&](std::size_t texture) { return textureIndexOf(texture); });
    const auto [found, isNew] = materialOf_.try_emplace(json.dump(-1, ' ', false, replaceBadUtf8), materials.size());
    if (isNew)
      materials.push_back(std::move(json));
    return found->second;
  }

  std::optional<std::size_t> textureIndexOf(std::size_t index) {
    if (const auto found = textureOf_.find(index); found != textureOf_.end())
      return found->second;
    const Texture& texture = scene_.graph.textures.at(index);
    const ImageFile& image = scene_.graph.images.at(texture.image);
    std::optional<std::size_t>& gltfIndex = textureOf_[index];
    const std::string_view start = asText(image.bytes);
    const char* type = start.starts_with("\x89PNG")        ? "image/png"
                       : start.starts_with("\xff\xd8\xff") ? "image/jpeg"
                       : start.starts_with("RIFF")         ? "image/webp"
                                                           : nullptr;
    if (!type)
      return gltfIndex;
    const auto [imageIndex, isNew] = imageOf_.try_emplace(texture.image, images.size());
    if (isNew)
      images.push_back({{"bufferView", arrays.addBytes(image.bytes)}, {"mimeType", type}});
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
  std::vector<Json> primitives_; ///< by mesh
  std::map<std::tuple<std::size_t, std::optional<std::size_t>, bool>, std::size_t> meshOf_;
  std::map<std::string, std::size_t> materialOf_; ///< by its text
  std::map<std::size_t, std::optional<std::size_t>> textureOf_;
  std::map<std::size_t, std::size_t> imageOf_;
};

void appendChunk(Bytes& glb, std::uint32_t type, ByteSpan data, std::uint8_t padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  appendLittle(glb, narrow<std::uint32_t>(padded));
  appendLittle(glb, type);
  glb.insert(glb.end(), data.begin(), data.end());
  glb.resize(glb.size() + padded - data.size(), padding);
}

/// The types of the first NavigationInfo that has any: glTF has no word for them.
std::vector<std::string> navigationTypes(const SceneGraph& graph) {
  for (const std::size_t index : nodesInOrder(graph)) {
    const Node& node = graph.nodes[index];
    const GenericNode* other = std::get_if<GenericNode>(&node.content);
    const auto type = std::ranges::find(node.fields, "type", &FieldText::name);
    if (other && other->element == "NavigationInfo" && type != node.fields.end())
      return parseStrings(type->value);
  }
  return {};
}

} // namespace

Bytes writeGlb(const Scene& scene) {
  const GltfBuilder gltf(scene);
  const Arrays& arrays = gltf.arrays;
  Json root{{"asset", {{"version", "2.0"}, {"generator", "imgeo"}}}};
  const std::string looks = Json{gltf.materials, gltf.textures}.dump(-1, ' ', false, Json::error_handler_t::replace);
  for (const char* extension : {"KHR_materials_unlit", "KHR_texture_transform", "EXT_texture_webp"})
    if (looks.find(extension) != looks.npos)
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

std::size_t lightsLeftOut(const SceneGraph& graph) {
  const auto isLeftOut = [&](std::size_t node) {
    const NodeContent& content = graph.nodes[node].content;
    const bool isLight = std::holds_alternative<DirectionalLight>(content) ||
                         std::holds_alternative<PointLight>(content) || std::holds_alternative<SpotLight>(content);
    return isLight && !lightOf(content);
  };
  return static_cast<std::size_t>(std::ranges::count_if(nodesInOrder(graph), isLeftOut));
}

} // namespace imgeo
