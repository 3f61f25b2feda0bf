#pragma once
// The XML section of an E57 file (ASTM E2807, 8): its scans, the fields of their points and where these are.

#include "base/affine.h"
#include "import/e57/paged_file.h"
#include "import/e57/point_fields.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace imgeo::e57 {

struct Limits {
  double minimum = 0, maximum = 1;
};

struct Scan {
  std::string name;              ///< may be empty
  std::uint64_t section = 0;     ///< logical offset of the binary section of its points
  std::uint64_t recordCount = 0; ///< together with those of the other scans no more than the file can hold
  std::vector<Field> fields;     ///< in the order of the bytestreams
  Affine3d pose;                 ///< from the scan's coordinates to those of the file
  std::array<std::optional<Limits>, 3> colorLimits; ///< of red, green and blue, where the file states them
  std::optional<Limits> intensityLimits;
};

struct Description {
  std::vector<Scan> scans; ///< those with points
  std::string wkt;         ///< the reference system as Well Known Text, where the file states it
  std::size_t images = 0;  ///< pictures, which are not read
};

/// Throws Error (truncated, malformed, unsupported, limit) with the byte of the element.
Description readDescription(PagedFile& file, const std::string& name);

} // namespace imgeo::e57
