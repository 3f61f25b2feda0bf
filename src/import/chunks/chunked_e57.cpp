#include "import/chunks/chunked_e57.h"

#include "base/error.h"

namespace imgeo {

ChunkedE57::ChunkedE57(SourceContent content, std::uint64_t chunkRecords)
    : ChunkedSource(std::move(content), Topology::points) {
  e57::PagedFile file(bytes(), name_);
  description_ = e57::readDescription(file, name_);
  if (description_.scans.size() > 1)
    throw Error(ErrorKind::unsupported, name_,
                "has several scans, each of which is a shape, and is not read piece by piece");
  if (!description_.scans.empty())
    pieces_ = e57::piecesOf(file, description_.scans[0], chunkRecords);
  for (const e57::ScanPiece& piece : pieces_) {
    const std::uint64_t before = survey_.points;
    e57::survey(survey_, bytes(), name_, description_, piece);
    add({.records = piece.range.count, .elements = survey_.points - before});
  }
  if (survey_.points == 0)
    throw Error(ErrorKind::malformed, name_,
                survey_.invalid > 0 ? "all points are marked as invalid" : "has no points");
}

Imported ChunkedE57::read(std::size_t number, const ImportOptions& options) const {
  return e57::readPiece(bytes(), name_, options, description_, survey_, pieces_[number]);
}

} // namespace imgeo
