#pragma once
// Pieces of E57 files of one scan.

#include "import/chunks/chunked_source.h"
#include "import/e57/e57.h"

#include <vector>

namespace imgeo {

class ChunkedE57 : public ChunkedSource {
public:
  /// Reads the file twice: for where pieces begin, and for what its points have in common. Throws Error{unsupported}
  /// for files of several scans.
  ChunkedE57(SourceContent content, std::uint64_t chunkRecords);
  Imported read(std::size_t chunk, const ImportOptions& options) const override;

private:
  e57::Description description_;
  std::vector<e57::ScanPiece> pieces_; ///< by chunk
  e57::ScanSurvey survey_;
};

} // namespace imgeo
