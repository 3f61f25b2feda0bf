#pragma once
// Pieces of GLB files: small documents with the elements and the vertices of a piece, which the format's own reader
// reads.

#include "import/chunks/chunked_source.h"
#include "import/chunks/glb_text.h"
#include "import/gltf/primitive.h"
#include "import/gltf/read_document.h"

#include <map>
#include <optional>
#include <utility>

namespace imgeo {

class ChunkedGlb : public ChunkedSource {
public:
  /// Throws Error{unsupported} for files with strips, fans or lines, with skins or morph targets, and whose vertices
  /// are compressed, sparse or in other files.
  ChunkedGlb(SourceContent content, std::uint64_t chunkRecords);
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;
  Imported readMeshes(const std::set<std::size_t>& meshes, const ImportOptions& options) const override;

private:
  /// Elements of an accessor, and its description.
  struct Array {
    gltf::Accessor accessor;
    gltf::Json json;
  };

  /// The vertices and elements of a primitive.
  struct Arrays {
    std::vector<std::pair<std::string, Array>> attributes;
    std::optional<Array> indices;
    std::size_t vertexCount = 0;
    Topology topology = Topology::triangles;
  };

  /// What is known of these, which may be those of several primitives.
  struct Counts {
    std::uint64_t elements = 0;
    Topology topology = Topology::triangles;
    std::size_t corners = 0; ///< of all elements, and those that make no whole one
  };

  /// Where a primitive is in the file.
  struct Entry {
    std::uint32_t mesh = 0, primitive = 0;
    std::string_view text;
  };

  /// A mesh of the scene: the first primitive that has it.
  struct MeshOfScene {
    Entry entry;
    std::set<std::size_t> texCoordSets;
    const Counts* counts = nullptr; ///< absent where the primitive is damaged
    auto key() const { return std::pair(counts, texCoordSets); }
  };

  class PartReader;

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;

  [[noreturn]] void refuse(const char* reason) const;
  void findCounts(gltf::Document& document, PrimitiveDocument& primitives);
  Arrays arraysOf(gltf::Document& document, const gltf::Value& primitive) const;
  Array arrayOf(gltf::Document& document, std::size_t accessor) const;
  /// The counts of a primitive, or nullptr where it is damaged.
  const Counts* countsOf(const gltf::Json& primitive) const;
  /// The vertices of the corners of so many elements, from `begin` on.
  std::vector<std::uint32_t> cornersOf(const Arrays& arrays, std::size_t begin, std::size_t count) const;
  /// Whether it names vertices that are there.
  bool hasFirstElement(const Arrays& arrays) const;
  /// A primitive with so many elements of the one that `document` has entered, from `begin` on, in a further buffer.
  gltf::Json pieceOf(PrimitiveDocument& document, gltf::Json primitive, const Arrays& arrays, std::size_t begin,
                     std::size_t count) const;
  PrimitiveDocument primitiveDocument(const References& references) const;
  /// Reads the scene with one element of each mesh whose counts are not among `whole`. `meshes`: those of the scene.
  Imported readScene(const std::set<const Counts*>& whole, const ImportOptions& options,
                     std::vector<MeshOfScene>& meshes) const;

  gltf::GlbChunks chunks_; ///< of the file
  GlbText text_;
  std::map<std::string, Counts> counts_; ///< by the text of a primitive without what does not matter to its mesh
  std::vector<MeshOfScene> ofScene_;     ///< by number of the mesh
};

} // namespace imgeo
