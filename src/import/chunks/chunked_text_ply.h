#pragma once
// Pieces of PLY files of text.

#include "import/chunks/chunked_source.h"
#include "import/chunks/ply_piece_textures.h"
#include "import/ply/header.h"

#include <optional>

namespace imgeo {

class ChunkedTextPly : public ChunkedSource {
public:
  /// Reads the file once, for where its records are.
  ChunkedTextPly(SourceContent content, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  void findElements();
  void findRecords(std::uint64_t chunkRecords);
  void makeFileOfFaces(Bytes& file, const Chunk& chunk) const;
  std::string_view text(std::size_t begin, std::size_t end) const;
  /// Appends the lines of vertices, of which `indices` has the numbers in ascending order.
  void appendVertices(Bytes& file, const std::vector<std::uint32_t>& indices) const;

  PlyHeader header_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr; ///< nullptr: the vertices are points
  std::optional<PlyPieceTextures> textures_;
  std::vector<std::size_t> vertexOffsets_; ///< of each vertex of faces whose number is a multiple of verticesAnOffset
  std::size_t trailingBytes_ = 0;          ///< behind the last record
};

} // namespace imgeo
