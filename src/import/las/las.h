#pragma once
// LAS point clouds (ASPRS, "LAS Specification" 1.0 to 1.4): points of all formats with their colours; intensity,
// classification, returns, scan angle, user data, source, GPS time, near infrared and extra bytes as further
// attributes. Points that are marked as withheld are left out. Coordinates far from zero are stored around an origin,
// which the document's metadata state (MetadataSet "georeference"), with the reference system. Waveforms are not read;
// LAZ, compressed LAS, is refused.

#include "import/import.h"
#include "import/las/header.h"

#include <array>
#include <limits>
#include <vector>

namespace imgeo {

/// Whether bytes begin with "LASF".
bool isLas(ByteSpan bytes);
Imported readLas(ByteSpan bytes, const std::string& name, const ImportOptions& options);

namespace las {

/// What the points of a file have in common, of those that are not withheld.
struct Survey {
  std::uint64_t pointCount = 0;
  std::uint16_t largestChannel = 0;
  std::array<std::int64_t, 3> lowest{}, highest{}; ///< stored coordinates
  double firstTime = std::numeric_limits<double>::infinity();
  std::vector<bool> hasValues; ///< by dimension: whether a value is not zero

  explicit Survey(const Header& header);
  /// Adds a record, unless it is withheld.
  void add(const Header& header, const std::uint8_t* record);

private:
  std::size_t time_; ///< the dimension of GPS times; the number of dimensions where there is none
};

/// Some points of a file, one after the other.
struct PointRange {
  std::uint64_t first = 0, count = 0; ///< records, withheld ones included
};

/// Reads points of a file; `survey` is that of all points. Warns of what concerns the whole file where the range begins
/// with its first point.
Imported readLasPoints(ByteSpan bytes, const std::string& name, const ImportOptions& options, const Header& header,
                       const Survey& survey, const PointRange& range);

} // namespace las

} // namespace imgeo
