#pragma once
// Vertex attributes and indices of meshes as the buffer views and accessors of glTF 2.0 (section 3.6).

#include "base/bytes.h"
#include "scene/mesh.h"

#include <nlohmann/json.hpp>

namespace imgeo {

using Json = nlohmann::ordered_json;

// Constants of glTF, named as in its specification.
inline constexpr int arrayBuffer = 34962, unsignedShort = 5123, floatType = 5126;

/// The binary chunk of a GLB file, and the buffer views and accessors that describe it.
class GltfArrays {
public:
  Bytes bytes;
  Json views = Json::array(), accessors = Json::array();

  /// Call before appending the bytes of an array.
  void begin() { beginOffset_ = bytes.size(); }

  /// Describes the bytes appended since begin(). Returns the accessor's index.
  std::size_t end(int target, int componentType, const char* type, std::size_t count) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", beginOffset_}, {"byteLength", bytes.size() - beginOffset_}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", componentType}, {"count", count}, {"type", type}});
    bytes.resize((bytes.size() + 3) / 4 * 4); // the next array begins at a multiple of 4 bytes
    return accessors.size() - 1;
  }

  /// Appends a file. Returns the index of its buffer view.
  std::size_t addFile(const Bytes& file) {
    views.push_back({{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", file.size()}});
    bytes.insert(bytes.end(), file.begin(), file.end());
    bytes.resize((bytes.size() + 3) / 4 * 4);
    return views.size() - 1;
  }

private:
  std::size_t beginOffset_ = 0; ///< set by begin()
};

/// Appends the arrays of a mesh and returns its primitive, without a material.
Json gltfPrimitive(GltfArrays& arrays, const Mesh& mesh);

} // namespace imgeo
