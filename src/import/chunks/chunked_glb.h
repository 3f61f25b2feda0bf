#pragma once
// Pieces of GLB files: small documents with the elements and the vertices of a piece, which the format's own reader
// reads.

#include "import/chunks/chunked_source.h"
#include "import/gltf/document.h"
#include "import/gltf/nodes.h"

#include <map>
#include <utility>

namespace imgeo {

class ChunkedGlb : public ChunkedSource {
public:
  /// Throws Error{unsupported} for files with strips, fans or lines, with skins or morph targets, and whose vertices
  /// are compressed, sparse or in other files.
  ChunkedGlb(SourceContent content, std::uint64_t chunkRecords);
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

private:
  /// Elements of an accessor, and its description.
  struct Array {
    gltf::Accessor accessor;
    gltf::Json json;
  };

  /// The vertices and elements of primitives, which may be those of several.
  struct Arrays {
    std::vector<std::pair<std::string, Array>> attributes;
    std::optional<Array> indices;
    std::size_t vertexCount = 0;
    Topology topology = Topology::triangles;

    std::uint64_t elementCount() const {
      return (indices ? indices->accessor.count() : vertexCount) / cornersPerElement(topology);
    }
  };

  /// A mesh of the scene: the first primitive that has it.
  struct MeshOfScene {
    gltf::Json primitive;
    std::set<std::size_t> texCoordSets;
    const Arrays* arrays = nullptr;
    auto key() const { return std::pair(arrays, texCoordSets); }
  };

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;

  [[noreturn]] void refuse(const char* reason) const;
  void findArrays(gltf::Document& document);
  Arrays arraysOf(gltf::Document& document, const gltf::Value& primitive) const;
  Array arrayOf(gltf::Document& document, std::size_t accessor) const;
  /// The arrays of a primitive, or nullptr where it is damaged.
  const Arrays* arraysOf(const gltf::Json& primitive) const;
  /// The vertices of the corners of so many elements, from `begin` on.
  std::vector<std::uint32_t> cornersOf(const Arrays& arrays, std::size_t begin, std::size_t count) const;
  /// Whether it names vertices that are there.
  bool hasFirstElement(const Arrays& arrays) const;
  /// Lets a primitive of a document have so many elements instead, from `begin` on, which are in a further buffer, the
  /// document's last: `buffer`.
  void setPiece(gltf::Json& document, gltf::Json& primitive, const Arrays& arrays, std::size_t begin, std::size_t count,
                Bytes& buffer) const;
  /// Reads the scene with one element of each mesh whose arrays are not among `whole`. `meshes`: those of the scene.
  Imported readScene(const std::set<const Arrays*>& whole, const ImportOptions& options,
                     std::vector<MeshOfScene>& meshes) const;

  gltf::Json json_;
  ByteSpan binary_;
  std::map<std::string, Arrays> arrays_; ///< by the text of a primitive without what does not matter to its mesh
  std::vector<MeshOfScene> ofScene_;     ///< by number of the mesh
};

} // namespace imgeo
