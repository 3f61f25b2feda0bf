#pragma once
// Pieces of PTS files.

#include "import/chunks/chunked_source.h"

namespace imgeo {

class ChunkedPts : public ChunkedSource {
public:
  /// Reads the file once, for where its lines are and for the origin of its coordinates. Throws Error{unsupported} for
  /// files of several scans, each of which is a shape.
  ChunkedPts(SourceContent content, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  Vec3d origin_;
};

} // namespace imgeo
