#include "import/chunks/chunked_e57.h"

#include "base/error.h"
#include "import/complete_import.h"

namespace imgeo {

ChunkedE57::ChunkedE57(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points) {
  e57::PagedFile file(bytes(), name_);
  description_ = e57::readDescription(file, name_);
  removeMeshes();
  for (std::size_t scan = 0; scan < description_.scans.size(); ++scan) {
    bool hasPoints = false;
    for (e57::ScanPiece& piece : e57::piecesOf(file, description_, scan, chunkRecords)) {
      const std::uint64_t before = survey_.points;
      e57::survey(survey_, bytes(), name_, description_, piece);
      if (survey_.points == before)
        continue;
      if (!std::exchange(hasPoints, true)) {
        beginMesh(Topology::points);
        firstPieces_.push_back(pieces_.size());
      }
      add({.offset = pieces_.size(), .records = piece.range.count, .elements = survey_.points - before});
      pieces_.push_back(std::move(piece));
    }
  }
  if (survey_.points == 0)
    throw Error(ErrorKind::malformed, name_,
                survey_.invalid > 0 ? "all points are marked as invalid" : "has no points");
}

Imported ChunkedE57::readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const {
  std::vector<e57::ScanPiece> pieces;
  for (std::size_t mesh = 0; mesh < meshCount(); ++mesh) {
    const e57::ScanPiece& first = pieces_[firstPieces_[mesh]];
    pieces.push_back(whole.contains(mesh) ? e57::ScanPiece::whole(description_, first.scan) : first);
  }
  Imported imported = e57::readPieces(bytes(), name_, options, description_, survey_, pieces);
  completeImport(imported, false, options, name_);
  return imported;
}

Imported ChunkedE57::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  return e57::readPieces(bytes(), name_, options, description_, survey_, std::span(&pieces_[chunk.offset], 1));
}

} // namespace imgeo
