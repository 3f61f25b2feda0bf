#pragma once
// Pieces of binary PLY files.

#include "import/chunks/chunked_ply_base.h"

namespace imgeo {

class ChunkedPly : public ChunkedPlyBase {
public:
  ChunkedPly(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords);

private:
  struct Face {
    std::size_t end = 0; ///< of its bytes
    std::uint64_t corners = 0;
    std::uint32_t texture = noPlyTexture;
  };

  void makeFileOfPoints(Bytes& file, const Chunk& chunk) const override;
  void makeFileOfFaces(Bytes& file, const Chunk& chunk, const FaceRange& range) const override;
  void visitAllFaces(const VisitFace& visit) const override;
  void findElements();
  void findFaces();
  void findPoints();
  std::size_t endOf(const PlyElement& element, std::size_t offset) const;
  std::string pieceHeader(std::uint64_t vertexCount, std::uint64_t faceCount) const;
  std::uint64_t integerAt(const std::uint8_t* from, PlyType type) const;
  /// Appends the bytes of an integer of `type`.
  void appendInteger(Bytes& out, std::uint64_t value, PlyType type) const;
  /// The face of a number that begins at `offset` of bytes. Throws Error{truncated, malformed}.
  Face faceAt(ByteSpan bytes, std::size_t offset, std::uint64_t number) const;
  template <typename Visit> std::size_t visitIndices(ByteSpan bytes, std::size_t offset, Visit visit) const;
  template <typename Visit> void visitFaces(const Chunk& chunk, const FaceRange& range, Visit visit) const;

  std::size_t verticesOffset_ = 0, vertexBytes_ = 0, facesOffset_ = 0;
};

} // namespace imgeo
