#pragma once
// The binary section of the points of an E57 scan (ASTM E2807, 9): a header, then packets of data, of an index, or
// empty ones.

#include "import/e57/description.h"
#include "import/e57/paged_file.h"
#include "import/e57/point_fields.h"

#include <span>

namespace imgeo::e57 {

/// Reads packet by packet until all `values` are complete. One element for each field of the scan; null: the field is
/// not needed. `firstPacket`: its logical offset; 0: that of the section's first. Throws Error (truncated, malformed)
/// with the byte.
void readPackets(PagedFile& file, const Scan& scan, std::span<FieldValues* const> values,
                 std::uint64_t firstPacket = 0);

/// Records of a scan, and where they are.
struct ScanPiece {
  std::size_t scan = 0; ///< its number in the file
  RecordRange range{};
  std::uint64_t firstPacket = 0;    ///< as readPackets() takes it
  std::vector<FieldState> states{}; ///< by field, of the bytestreams before that packet

  static ScanPiece whole(const Description& description, std::size_t scan) {
    const Scan& records = description.scans.at(scan);
    return {scan, {0, records.recordCount}, 0, std::vector<FieldState>(records.fields.size())};
  }
};

/// Divides a scan into pieces of at least `records`, each of which begins between two packets; fields may be ahead of
/// others there. Throws Error (truncated, malformed) with the byte, {unsupported} where fields are so far ahead that
/// pieces are much larger.
std::vector<ScanPiece> piecesOf(PagedFile& file, const Description& description, std::size_t scan,
                                std::uint64_t records);

} // namespace imgeo::e57
