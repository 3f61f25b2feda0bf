#pragma once
// Pieces of PTS files.

#include "import/chunks/chunked_source.h"

#include <vector>

namespace imgeo {

class ChunkedPts : public ChunkedSource {
public:
  /// Reads the file once, for where its lines are and for the origin of its coordinates.
  ChunkedPts(SourceContent content, std::uint64_t chunkRecords);
  Imported readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const override;

private:
  /// Lines of points that follow one another.
  struct Lines {
    std::size_t offset = 0, end = 0;
    std::uint64_t count = 0;
  };
  struct Scan {
    Lines first, all; ///< of its first piece, and all its points; scans without points are no meshes
  };

  Imported readChunk(const Chunk& chunk, const ImportOptions& options) const override;
  /// Appends a scan of such points to a file.
  void appendScan(Bytes& file, const Lines& lines) const;

  std::vector<Scan> scans_;
  Vec3d origin_;
};

} // namespace imgeo
