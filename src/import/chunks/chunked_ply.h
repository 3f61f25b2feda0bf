#pragma once
// Pieces of binary PLY files.

#include "import/chunks/chunked_source.h"
#include "import/chunks/ply_piece_textures.h"
#include "import/ply/header.h"

#include <optional>

namespace imgeo {

class ChunkedPly : public ChunkedSource {
public:
  ChunkedPly(SourceContent content, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  void findElements();
  void findChunks(std::uint64_t chunkRecords);
  void findChunksOfPoints(std::uint64_t chunkRecords);
  std::size_t endOf(const PlyElement& element, std::size_t offset) const;
  std::string pieceHeader(std::uint64_t vertexCount, std::uint64_t faceCount, bool isFirst) const;
  std::uint64_t integerAt(std::size_t offset, PlyType type) const;
  /// Appends the bytes of an integer of `type`.
  void appendInteger(Bytes& out, std::uint64_t value, PlyType type) const;
  void makeFileOfFaces(Bytes& file, const Chunk& chunk) const;
  template <typename Visit> void visitIndices(const Chunk& chunk, Visit visit) const;

  PlyHeader header_;
  const PlyElement* vertices_ = nullptr;
  const PlyElement* faces_ = nullptr; ///< nullptr: the vertices are points
  std::optional<PlyPieceTextures> textures_;
  std::size_t verticesOffset_ = 0, vertexBytes_ = 0, facesOffset_ = 0;
  std::size_t trailingBytes_ = 0; ///< behind the last element
};

} // namespace imgeo
