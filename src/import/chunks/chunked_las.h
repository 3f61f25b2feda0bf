#pragma once
// Pieces of LAS files.

#include "import/chunks/chunked_source.h"
#include "import/las/las.h"

namespace imgeo {

class ChunkedLas : public ChunkedSource {
public:
  /// Reads the file once, for what its points have in common.
  ChunkedLas(SourceContent content, std::uint64_t chunkRecords);
  Imported read(std::size_t chunk, const ImportOptions& options) const override;

private:
  las::Header header_;
  las::Survey survey_;
};

} // namespace imgeo
