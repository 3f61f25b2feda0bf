#pragma once
// Shape Resource Containers for tests, in both layouts.

#include "base/bytes.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace imgeo::testing {

inline Bytes containerFile(std::initializer_list<std::uint32_t> header, const nlohmann::ordered_json& json,
                           const Bytes& body) {
  const std::string text = json.dump();
  Bytes bytes;
  for (const std::uint32_t word : header)
    appendLittle(bytes, word);
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

/// The layout of X3DOM 1.6: three words before the JSON.
inline Bytes srcFile(const nlohmann::ordered_json& json, const Bytes& body) {
  return containerFile({23, 42, static_cast<std::uint32_t>(json.dump().size())}, json, body);
}

/// The layout of X3DOM 1.7: a binary file of glTF 1.0.
inline Bytes glbFile(const nlohmann::ordered_json& json, const Bytes& body) {
  const std::uint32_t length = static_cast<std::uint32_t>(json.dump().size());
  return containerFile({0x46546c67, 1, 20 + length + static_cast<std::uint32_t>(body.size()), length, 0}, json, body);
}

/// The square (0, 0, 1) … (2, 2, 1): 4 positions, normals to +z and texture coordinates as Float32, bytes of colours,
/// the indices of its 2 triangles, and of a line along its diagonal.
inline Bytes squareBody() {
  Bytes body;
  for (const auto& [x, y] : {std::pair{0.f, 0.f}, {2.f, 0.f}, {2.f, 2.f}, {0.f, 2.f}})
    for (const float value : {x, y, 1.f, 0.f, 0.f, 2.f, x / 2, y / 2})
      appendLittle(body, value);
  for (const std::uint32_t color : {0xff0000ffu, 0xff00ff00u, 0xffff0000u, 0x80ffffffu})
    appendLittle(body, color);
  for (const int index : {0, 1, 2, 0, 2, 3, 0, 2})
    appendLittle(body, static_cast<std::uint16_t>(index));
  return body;
}

/// The accessors of squareBody(), whose names end in `suffix`, without those of indices.
inline nlohmann::ordered_json squareAccessors(const std::string& vertices, const std::string& colors) {
  const auto accessor = [](const std::string& view, int offset, int stride, int type, const char* components) {
    return nlohmann::ordered_json{{"bufferView", view},    {"byteOffset", offset}, {"byteStride", stride},
                                  {"componentType", type}, {"count", 4},           {"type", components}};
  };
  return {{"positions", accessor(vertices, 0, 32, 5126, "VEC3")},
          {"normals", accessor(vertices, 12, 32, 5126, "VEC3")},
          {"texCoords", accessor(vertices, 24, 32, 5126, "VEC2")},
          {"colors", accessor(colors, 0, 4, 5121, "VEC4")}};
}

inline nlohmann::ordered_json indexAccessor(const std::string& view, int offset, int count) {
  return {{"bufferView", view}, {"byteOffset", offset}, {"componentType", 5123}, {"count", count}, {"type", "SCALAR"}};
}

/// The header of SRC of squareBody(), with the vertices in two chunks.
inline nlohmann::ordered_json squareSrc() {
  auto json = nlohmann::ordered_json::parse(R"({"bufferChunks":{"c0":{"byteOffset":0,"byteLength":64},
    "c1":{"byteOffset":64,"byteLength":64},"colors":{"byteOffset":128,"byteLength":16},
    "indices":{"byteOffset":144,"byteLength":16}},
    "bufferViews":{"vertices":{"byteLength":128,"chunks":["c0","c1"]},"colors":{"chunks":["colors"]},
    "indices":{"chunks":["indices"]}},"accessors":{},"meta":{"generator":"test"},
    "meshes":{"square":{"attributes":{"position":"positions","normal":"normals","texcoord":"texCoords",
      "color":"colors","id":"unknown"},"indices":"triangles","primitive":4,"bboxCenter":[1,1,1]},
      "diagonal":{"attributes":{"position":"positions"},"indices":"line","primitive":1}}})");
  json["accessors"]["attributeViews"] = squareAccessors("vertices", "colors");
  for (auto& [name, accessor] : json["accessors"]["attributeViews"].items()) {
    accessor["decodeOffset"] = {0, 0, 0};
    accessor["decodeScale"] = {1, 1, 1};
  }
  json["accessors"]["indexViews"] = {{"triangles", indexAccessor("indices", 0, 6)},
                                     {"line", indexAccessor("indices", 12, 2)}};
  return json;
}

/// The JSON of glTF 1.0 of squareBody(). A third mesh is not in the scene.
inline nlohmann::ordered_json squareGltf() {
  auto json =
      nlohmann::ordered_json::parse(R"({"asset":{"version":"1.0"},"extensionsUsed":["KHR_binary_glTF","WEB3D_SRC"],
    "bufferViews":{"vertices":{"buffer":"binary_glTF","byteOffset":0,"byteLength":128,"target":34962},
      "colors":{"buffer":"binary_glTF","byteOffset":128,"byteLength":16,"target":34962},
      "indices":{"buffer":"binary_glTF","byteOffset":144,"byteLength":16,"target":34963}},
    "materials":{"red":{"extensions":{"KHR_materials_common":{"technique":"PHONG","doubleSided":true,
      "values":{"diffuse":[1,0.25,0,1],"specular":[0.5,0.5,0.5,1],"shininess":64,"transparency":0.25}}}},
      "glow":{"values":{"emission":[0,1,0,1]}}},
    "meshes":{"square":{"primitives":[{"attributes":{"POSITION":"positions","NORMAL":"normals",
        "TEXCOORD_0":"texCoords","COLOR":"colors"},"indices":"triangles","mode":4,"material":"red"}]},
      "diagonal":{"primitives":[{"attributes":{"POSITION":"positions"},"indices":"line","mode":1,"material":"glow"}]},
      "unused":{"primitives":[]}},
    "nodes":{"root":{"children":["a","b"],"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,0,0,0,1]},"a":{"meshes":["square"]},
      "b":{"meshes":["diagonal","square"],"children":["root"]}},
    "scenes":{"s":{"nodes":["root"]}},"scene":"s"})");
  json["accessors"] = squareAccessors("vertices", "colors");
  json["accessors"]["triangles"] = indexAccessor("indices", 0, 6);
  json["accessors"]["line"] = indexAccessor("indices", 12, 2);
  return json;
}

} // namespace imgeo::testing
