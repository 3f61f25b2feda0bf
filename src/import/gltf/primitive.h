#pragma once
// A primitive of a glTF mesh -> a Mesh.

#include "import/gltf/document.h"
#include "scene/mesh.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::gltf {

/// Where a primitive's numbers come from: accessors, or what Draco packed.
struct PrimitiveData {
  using Number = std::function<double(std::size_t vertex, std::uint32_t component)>;
  struct Attribute {
    std::string name; ///< "POSITION", "NORMAL", "TEXCOORD_0", ..., "_TEMPERATURE"
    std::uint32_t components = 0;
    Number number;
  };

  std::size_t vertexCount = 0;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> indices; ///< in range
  bool indexed = false;
  bool isTriangles = false; ///< whatever the primitive's mode says

  const Attribute* find(const std::string& name) const;
};

/// What could not be carried over, over all primitives.
struct PrimitiveLosses {
  std::uint64_t badNormals = 0, morphTargets = 0, skins = 0;
  std::set<std::string> attributes; ///< names of those that were left out
};

class PrimitiveReader {
public:
  PrimitiveReader(Document& document, const AttributeChoice& choice) : document_(document), choice_(choice) {}

  /// Throws Error for a primitive that cannot be read whole: an index out of range,
  /// coordinates that are no numbers.
  Mesh read(const Value& primitive);

  PrimitiveLosses losses;
  std::set<std::string> ownAttributes; ///< names of the author's own, kept or not

private:
  PrimitiveData dataOf(const Value& primitive);
  void addAccessors(const Value& primitive, PrimitiveData& data);
  void addVertices(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                   Mesh& mesh);
  void addNamedAttributes(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                          Mesh& mesh);
  std::vector<std::uint32_t> compact(std::vector<std::uint32_t>& corners, std::size_t vertexCount);

  Document& document_;
  const AttributeChoice& choice_;
  std::vector<std::uint32_t> localVertex_; ///< by the accessors'; all unset between primitives
};

/// KHR_draco_mesh_compression of a primitive. Throws Error.
PrimitiveData readDraco(Document& document, const Value& primitive, const Value& compression);

} // namespace imgeo::gltf
