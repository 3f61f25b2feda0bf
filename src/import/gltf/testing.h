#pragma once
// glTF documents for tests: JSON with one buffer, whose accessors are added one by one.

#include "base/bytes.h"
#include "import/import.h"
#include "import/references.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace imgeo::testing {

class GltfText {
public:
  using Json = nlohmann::ordered_json;

  GltfText() {
    json["asset"] = {{"version", "2.0"}};
    for (const char* list : {"nodes", "meshes", "accessors", "bufferViews"})
      json[list] = Json::array();
  }

  Json json;
  Bytes buffer;

  std::size_t addView(const Bytes& bytes) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    return json["bufferViews"].size() - 1;
  }

  template <typename T>
  std::size_t addAccessor(const std::vector<T>& values, const std::string& type, int componentType,
                          bool normalized = false) {
    Bytes bytes;
    for (const T value : values)
      appendLittle(bytes, value);
    const std::size_t components = type == "SCALAR" ? 1
                                   : type == "MAT4" ? 16
                                                    : static_cast<std::size_t>(type.back() - '0');
    json["accessors"].push_back({{"bufferView", addView(bytes)},
                                 {"componentType", componentType},
                                 {"count", values.size() / components},
                                 {"type", type}});
    if (normalized)
      json["accessors"].back()["normalized"] = true;
    return json["accessors"].size() - 1;
  }

  /// Adds a triangle in the plane z = `z` as a mesh of its own; returns the mesh's index.
  std::size_t addTriangle(float z = 0) {
    const std::size_t positions = addAccessor<float>({0, 0, z, 1, 0, z, 0, 1, z}, "VEC3", 5126);
    return addMesh({{{"attributes", {{"POSITION", positions}}}}});
  }

  std::size_t addMesh(const std::vector<Json>& primitives) {
    json["meshes"].push_back({{"primitives", primitives}});
    return json["meshes"].size() - 1;
  }

  std::size_t addNode(Json node) {
    json["nodes"].push_back(std::move(node));
    return json["nodes"].size() - 1;
  }

  /// Adds a node that shows a mesh.
  GltfText& show(std::size_t mesh) {
    addNode({{"mesh", mesh}});
    return *this;
  }

  std::string text() const {
    Json whole = json;
    whole["buffers"] = Json::array({{{"byteLength", buffer.size()}, {"uri", dataUrl(buffer)}}});
    return whole.dump();
  }

  Bytes glb() const {
    Json whole = json;
    whole["buffers"] = Json::array({{{"byteLength", buffer.size()}}});
    std::string text = whole.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    Bytes bytes;
    for (const std::uint32_t word : {0x46546c67u, 2u, static_cast<std::uint32_t>(28 + text.size() + buffer.size()),
                                     static_cast<std::uint32_t>(text.size()), 0x4e4f534au})
      appendLittle(bytes, word);
    bytes.insert(bytes.end(), text.begin(), text.end());
    appendLittle(bytes, static_cast<std::uint32_t>(buffer.size()));
    appendLittle(bytes, 0x004e4942u);
    bytes.insert(bytes.end(), buffer.begin(), buffer.end());
    return bytes;
  }

  static std::string dataUrl(const Bytes& bytes) { return dataUrlOf(bytes, "application/octet-stream"); }
};

/// Imports a document.
inline Imported read(const GltfText& gltf, const ImportOptions& options = {}) {
  return importBytes(asBytes(gltf.text()), "a.gltf", options);
}

} // namespace imgeo::testing
