#pragma once
// Pieces of the scans of E57 files.

#include "import/chunks/chunked_source.h"
#include "import/e57/e57.h"

#include <vector>

namespace imgeo {

class ChunkedE57 : public ChunkedSource {
public:
  /// Reads the file twice: for where pieces begin, and for what its points have in common.
  ChunkedE57(SourceContent content, std::uint64_t chunkRecords);
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;

  e57::Description description_;
  std::vector<e57::ScanPiece> pieces_;   ///< those with points, of which chunks have the numbers as offsets
  std::vector<std::size_t> firstPieces_; ///< by mesh
  e57::PointSurvey survey_;
};

} // namespace imgeo
