#include "import/chunks/chunked_pts.h"

#include "base/error.h"
#include "import/complete_import.h"
#include "import/mesh/point_cloud.h"
#include "import/pts/pts.h"
#include "import/text/line_ends.h"

#include <fmt/format.h>

namespace imgeo {

ChunkedPts::ChunkedPts(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points) {
  requireLineFeeds(bytes(), name_);
  removeMeshes();
  PtsScanner scanner(bytes(), name_);
  Box3d box;
  while (scanner.hasScan()) {
    Scan& scan = scans_.emplace_back();
    scan.all.count = scanner.pointCount();
    if (scan.all.count > 0)
      beginMesh(Topology::points);
    for (std::uint64_t first = 0; first < scan.all.count;) {
      Chunk chunk;
      chunk.offset = scanner.beginOfPoint();
      for (; first < scan.all.count && chunk.records < chunkRecords; ++chunk.records, ++first)
        box.add(scanner.point(first, scan.all.count).position);
      chunk.end = scanner.byteOffset();
      chunk.elements = chunk.records;
      add(chunk);
      if (first == chunk.records) {
        scan.first = {chunk.offset, chunk.end, chunk.records};
        scan.all.offset = chunk.offset;
      }
      scan.all.end = chunk.end;
    }
  }
  if (box.empty())
    throw Error(ErrorKind::malformed, name_, "has no points");
  origin_ = originOf(box);
}

void ChunkedPts::appendScan(Bytes& file, const Lines& lines) const {
  const std::string count = fmt::format("{}\n", lines.count);
  const ByteSpan points = bytes().subspan(lines.offset, lines.end - lines.offset);
  file.insert(file.end(), count.begin(), count.end());
  file.insert(file.end(), points.begin(), points.end());
  file.push_back('\n');
}

Imported ChunkedPts::readScene(const std::set<std::size_t>& whole, const ImportOptions& options) const {
  Bytes file;
  std::size_t mesh = 0;
  for (const Scan& scan : scans_) // without points, too: shapes have the numbers of their scans
    appendScan(file, scan.all.count > 0 && whole.contains(mesh++) ? scan.all : scan.first);
  Imported imported = readPtsAround(origin_, file, name_, options);
  completeImport(imported, false, options, name_);
  return imported;
}

Imported ChunkedPts::readChunk(const Chunk& chunk, const ImportOptions& options) const {
  Bytes file;
  appendScan(file, {chunk.offset, chunk.end, chunk.records});
  return readPtsAround(origin_, file, name_, options);
}

} // namespace imgeo
