// Binary glTF 2.0 (Khronos Group, "glTF 2.0 Specification", sections 3.6 and 4).

#include "base/error.h"
#include "base/narrow.h"
#include "export/export.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace imgeo {

namespace {

using Json = nlohmann::ordered_json;

// The names that the specification gives its constants.
constexpr int arrayBuffer = 34962, elementArrayBuffer = 34963;
constexpr int unsignedShort = 5123, unsignedInt = 5125, floatType = 5126;
constexpr std::uint32_t jsonChunk = 0x4e4f534a, binaryChunk = 0x004e4942, magic = 0x46546c67;

/// The inverse of the sRGB transfer function (IEC 61966-2-1), 0..1.
double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// The binary chunk, and the views and accessors that say what lies where in it.
class Arrays {
public:
  Bytes bytes;
  Json views = Json::array(), accessors = Json::array();

  /// To be called before the bytes of an array are appended.
  void begin() { first_ = bytes.size(); }

  /// Describes what has been appended since begin(); returns the accessor's number.
  std::size_t end(int target, int componentType, const char* type, std::size_t count) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", first_}, {"byteLength", bytes.size() - first_}, {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", componentType},
                         {"count", count},
                         {"type", type}});
    bytes.resize((bytes.size() + 3) / 4 * 4); // arrays begin at whole words
    return accessors.size() - 1;
  }

private:
  std::size_t first_ = 0;
};

Json jsonOf(Vec3f v) {
  return {v.x, v.y, v.z};
}

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
  arrays.accessors.back()["min"] = jsonOf(min);
  arrays.accessors.back()["max"] = jsonOf(max);
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
    linearOf[i] = static_cast<std::uint16_t>(std::lround(65535 * linear(static_cast<double>(i) / 255)));
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

Json primitiveOf(Arrays& arrays, const Mesh& mesh, std::size_t material) {
  Json attributes{{"POSITION", addPositions(arrays, mesh)}};
  if (!mesh.normals.empty())
    attributes["NORMAL"] = addNormals(arrays, mesh);
  if (!mesh.texCoords.empty())
    attributes["TEXCOORD_0"] = addTexCoords(arrays, mesh);
  if (!mesh.colors.empty())
    attributes["COLOR_0"] = addColors(arrays, mesh);
  constexpr int modes[] = {0, 1, 4}; // POINTS, LINES, TRIANGLES
  return {{"attributes", attributes},
          {"indices", addIndices(arrays, mesh)},
          {"mode", modes[cornersPerElement(mesh.topology) - 1]},
          {"material", material}};
}

/// Vertex colours take the place of the diffuse colour in X3D, and multiply it in glTF.
Json materialOf(const Material& material, const Mesh& mesh) {
  const Vec3f diffuse = mesh.colors.empty() ? material.diffuseColor : Vec3f{1, 1, 1},
              emissive = material.emissiveColor;
  const bool clear = material.transparency > 0 || (!mesh.colors.empty() && mesh.colorComponents == 4);
  Json json{{"pbrMetallicRoughness",
             {{"baseColorFactor",
               {linear(diffuse.x), linear(diffuse.y), linear(diffuse.z), 1 - material.transparency}},
              {"metallicFactor", 0},
              {"roughnessFactor", 1 - material.shininess}}}};
  if (emissive != Vec3f{})
    json["emissiveFactor"] = {linear(emissive.x), linear(emissive.y), linear(emissive.z)};
  if (clear)
    json["alphaMode"] = "BLEND";
  return json;
}

void appendChunk(Bytes& glb, std::uint32_t type, ByteSpan data, std::uint8_t padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  appendLittle(glb, narrow<std::uint32_t>(padded));
  appendLittle(glb, type);
  glb.insert(glb.end(), data.begin(), data.end());
  glb.resize(glb.size() + padded - data.size(), padding);
}

} // namespace

Bytes writeGlb(const Scene& scene) {
  Arrays arrays;
  Json nodes = Json::array(), meshes = Json::array(), materials = Json::array(), roots = Json::array();
  for (const Shape& shape : scene.shapes) {
    const Mesh& mesh = scene.meshes[shape.mesh];
    materials.push_back(materialOf(shape.material, mesh));
    meshes.push_back({{"primitives", Json::array({primitiveOf(arrays, mesh, materials.size() - 1)})}});
    nodes.push_back({{"mesh", meshes.size() - 1}});
    if (!shape.name.empty())
      meshes.back()["name"] = nodes.back()["name"] = shape.name;
    roots.push_back(nodes.size() - 1);
  }
  const Json root{{"asset", {{"version", "2.0"}, {"generator", "imgeo"}}},
                  {"scene", 0},
                  {"scenes", Json::array({{{"nodes", roots}}})},
                  {"nodes", nodes},
                  {"meshes", meshes},
                  {"materials", materials},
                  {"accessors", arrays.accessors},
                  {"bufferViews", arrays.views},
                  {"buffers", Json::array({{{"byteLength", arrays.bytes.size()}}})}};
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
