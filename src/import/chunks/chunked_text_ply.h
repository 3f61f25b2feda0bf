#pragma once
// Pieces of PLY files of text.

#include "import/chunks/chunked_ply_base.h"

namespace imgeo {

class ChunkedTextPly : public ChunkedPlyBase {
public:
  /// Reads the file once, for where its records are.
  ChunkedTextPly(SourceContent content, const std::filesystem::path& scratch, std::uint64_t chunkRecords);

private:
  void makeFileOfPoints(Bytes& file, const Chunk& chunk) const override;
  void makeFileOfFaces(Bytes& file, const Chunk& chunk, const FaceRange& range) const override;
  void visitAllFaces(const VisitFace& visit) const override;
  void requireRecords() const;
  void findRecords();
  std::string_view text(std::size_t begin, std::size_t end) const;
  /// Appends the lines of vertices, of which `indices` has the numbers in ascending order.
  void appendVertices(Bytes& file, const std::vector<std::uint32_t>& indices) const;

  std::size_t facesOffset_ = 0;
  std::vector<std::size_t> vertexOffsets_; ///< of each vertex of faces whose number is a multiple of verticesAnOffset
};

} // namespace imgeo
