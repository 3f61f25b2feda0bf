#pragma once
// Pieces of point clouds as text.

#include "import/chunks/chunked_source.h"
#include "import/xyz/xyz_columns.h"

namespace imgeo {

class ChunkedXyz : public ChunkedSource {
public:
  /// Reads the file once, for where its lines are and for the origin of its coordinates.
  ChunkedXyz(SourceContent content, std::uint64_t chunkRecords);

private:
  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;

  XyzColumns columns_;
  Vec3d origin_;
};

} // namespace imgeo
