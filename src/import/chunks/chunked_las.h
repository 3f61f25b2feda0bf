#pragma once
// Pieces of LAS files.

#include "import/chunks/chunked_source.h"
#include "import/las/las.h"

namespace imgeo {

class ChunkedLas : public ChunkedSource {
public:
  /// Reads the file once, for what its points have in common.
  ChunkedLas(SourceContent content, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  las::Header header_;
  las::Survey survey_;
};

} // namespace imgeo
