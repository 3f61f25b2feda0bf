#include "import/chunks/chunked_las.h"

#include <algorithm>

namespace imgeo {

ChunkedLas::ChunkedLas(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points), header_(las::readHeader(bytes(), name_)), survey_(header_) {
  for (std::uint64_t first = 0; first < header_.pointCount; first += chunkRecords) {
    const std::uint64_t records = std::min(chunkRecords, header_.pointCount - first), before = survey_.pointCount;
    const std::size_t offset = header_.firstPoint + first * header_.recordBytes,
                      end = offset + records * header_.recordBytes;
    for (std::size_t at = offset; at < end; at += header_.recordBytes)
      survey_.add(header_, &bytes()[at]);
    add({offset, end, records, survey_.pointCount - before});
  }
}

Imported ChunkedLas::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  const std::uint64_t first = (chunk.offset - header_.firstPoint) / header_.recordBytes;
  return las::readLasPoints(bytes(), name_, options, header_, survey_, {first, chunk.records});
}

} // namespace imgeo
