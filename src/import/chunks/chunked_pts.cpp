#include "import/chunks/chunked_pts.h"

#include "base/error.h"
#include "import/mesh/point_cloud.h"
#include "import/pts/pts.h"

#include <fmt/format.h>

namespace imgeo {

ChunkedPts::ChunkedPts(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points) {
  PtsScanner scanner(bytes(), name_);
  const std::uint64_t count = scanner.hasScan() ? scanner.pointCount() : 0;
  Box3d box;
  for (std::uint64_t first = 0; first < count;) {
    Chunk chunk;
    chunk.offset = scanner.beginOfPoint();
    for (; first < count && chunk.records < chunkRecords; ++chunk.records, ++first)
      box.add(scanner.point(first, count).position);
    chunk.end = scanner.byteOffset();
    chunk.elements = chunk.records;
    add(chunk);
  }
  if (scanner.hasScan())
    throw Error(ErrorKind::unsupported, name_,
                "has several scans, each of which is a shape, and is not read piece by piece");
  if (count == 0)
    throw Error(ErrorKind::malformed, name_, "has no points");
  origin_ = originOf(box);
}

Imported ChunkedPts::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  const std::string count = fmt::format("{}\n", chunk.records);
  Bytes file(count.begin(), count.end());
  const ByteSpan lines = bytesOf(chunk);
  file.insert(file.end(), lines.begin(), lines.end());
  return readPtsAround(origin_, file, name_, options);
}

} // namespace imgeo
