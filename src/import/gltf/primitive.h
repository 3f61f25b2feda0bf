#pragma once
// Turns a primitive of a glTF mesh into a Mesh.

#include "import/gltf/document.h"
#include "scene/mesh.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace imgeo::gltf {

/// A primitive's data, from accessors or decoded by Draco.
struct PrimitiveData {
  using Number = std::function<double(std::size_t vertex, std::uint32_t component)>;
  struct Attribute {
    std::string name; ///< "POSITION", "NORMAL", "TEXCOORD_0", ..., "_TEMPERATURE"
    std::uint32_t components = 0;
    Number number;
  };

  std::size_t vertexCount = 0;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> indices; ///< all below vertexCount
  bool indexed = false;
  bool isTriangles = false; ///< overrides the primitive's mode

  const Attribute* find(const std::string& name) const;
};

/// Content of all primitives that was not carried over.
struct PrimitiveOmissions {
  std::uint64_t unusableNormals = 0;
  std::size_t surplusVertices = 0;  ///< behind the last whole triangle or line of their primitive
  std::size_t scaledWeights = 0;    ///< vertices whose weights of joints did not sum to one
  std::set<std::string> attributes; ///< names of attributes that were left out
  std::vector<std::string> damage;  ///< one warning for each primitive whose morph targets are left out
};

class PrimitiveReader {
public:
  PrimitiveReader(Document& document, const AttributeChoice& choice, bool isStrict)
      : document_(document), choice_(choice), isStrict_(isStrict) {}
  virtual ~PrimitiveReader() = default;

  /// Keeps the sets of texture coordinates that textures use, up to maxTexCoordSets of them; the first set if they use
  /// none. `jointCount`: of the skin; 0 without one. Throws Error for a damaged primitive: an index out of range,
  /// coordinates that are not finite.
  virtual Mesh read(const Value& primitive, const std::set<std::size_t>& texCoordSets, std::size_t jointCount);

  PrimitiveOmissions omissions;
  std::set<std::string> furtherAttributes; ///< names of application-specific attributes without "_", kept or not

protected:
  /// Counts vertices that make no whole triangle or line, which are left out; refuses them if strict. `drawn`: how many
  /// vertices the primitive draws.
  void checkWhole(const Value& primitive, std::uint64_t mode, std::size_t drawn);

private:
  PrimitiveData dataOf(const Value& primitive);
  void addAccessors(const Value& primitive, PrimitiveData& data);
  void addVertices(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                   Mesh& mesh);
  void addTexCoords(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                    const std::set<std::size_t>& sets, Mesh& mesh);
  void addNamedAttributes(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                          Mesh& mesh);
  void addTargets(const Value& primitive, const PrimitiveData& data, const std::vector<std::uint32_t>& vertices,
                  Mesh& mesh);
  std::vector<std::uint32_t> renumberVertices(std::vector<std::uint32_t>& corners, std::size_t vertexCount);

  Document& document_;
  const AttributeChoice& choice_;
  bool isStrict_;
  std::vector<std::uint32_t> localVertex_; ///< index in the mesh by vertex of the accessors; unset between primitives
};

/// Decodes KHR_draco_mesh_compression of a primitive. Throws Error.
PrimitiveData readDraco(Document& document, const Value& primitive, const Value& compression);

} // namespace imgeo::gltf
