#include "import/chunks/chunked_xyz.h"

#include "import/mesh/point_cloud.h"
#include "import/text/line_ends.h"
#include "import/xyz/xyz.h"

namespace imgeo {

ChunkedXyz::ChunkedXyz(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points) {
  requireLineFeeds(bytes(), name_);
  columns_ = xyzColumnsOf(bytes(), name_);
  NumberLines lines(bytes(), name_, maxXyzNumbers, columns_.begin);
  Box3d box;
  Chunk chunk;
  while (lines.next()) {
    if (chunk.records == 0)
      chunk.offset = lines.begin();
    chunk.end = lines.end();
    chunk.elements = ++chunk.records;
    box.add(xyzPosition(lines, xyzNumbers(lines, columns_.count), columns_));
    if (chunk.records == chunkRecords) {
      add(chunk);
      chunk = {};
    }
  }
  if (chunk.records > 0)
    add(chunk);
  origin_ = originOf(box);
}

Imported ChunkedXyz::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  return readXyzAround(origin_, bytesOf(chunk), columns_, name_, options);
}

} // namespace imgeo
