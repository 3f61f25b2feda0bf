#pragma once
// Pieces of GLB files of one primitive: small documents with the elements and the vertices of a piece, which the
// format's own reader reads. The first one has the whole scene.

#include "import/chunks/chunked_source.h"
#include "import/gltf/document.h"

#include <mutex>
#include <set>
#include <utility>

namespace imgeo {

class ChunkedGlb : public ChunkedSource {
public:
  /// Throws Error{unsupported} for files of several meshes or primitives, each of which is a shape, of strips, fans or
  /// lines, with skins or morph targets, and whose vertices are compressed, sparse or in other files.
  ChunkedGlb(SourceContent content, std::uint64_t chunkRecords);
  Imported read(std::size_t chunk, const ImportOptions& options) const override;

private:
  /// Elements of an accessor, and its description.
  struct Array {
    gltf::Accessor accessor;
    gltf::Json json;
  };

  [[noreturn]] void refuse(const char* reason) const;
  gltf::Value primitiveOf(const gltf::Value& root) const;
  Array arrayOf(gltf::Document& document, std::size_t accessor) const;
  void readArrays(gltf::Document& document, const gltf::Value& primitive);
  /// The vertices of the corners of a piece.
  std::vector<std::uint32_t> cornersOf(const Chunk& chunk) const;
  /// A document of one primitive with the elements of a piece instead, which are in a further buffer: `buffer`.
  gltf::Json withPiece(gltf::Json document, const Chunk& chunk, Bytes& buffer) const;
  /// The sets of texture coordinates that the textures of the primitive's materials use.
  const std::set<std::size_t>& texCoordSets(const References& references) const;

  gltf::Json json_;
  ByteSpan binary_;
  std::vector<std::pair<std::string, Array>> attributes_;
  std::optional<Array> indices_;
  std::size_t vertexCount_ = 0;
  mutable std::once_flag haveTexCoordSets_;
  mutable std::set<std::size_t> texCoordSets_;
};

} // namespace imgeo
