#pragma once
// The binary section of the points of an E57 scan (ASTM E2807, 9): a header, then packets of data, of an index, or
// empty ones.

#include "import/e57/description.h"
#include "import/e57/paged_file.h"
#include "import/e57/point_fields.h"

#include <span>

namespace imgeo::e57 {

/// Reads packet by packet until all `values` are complete. One element for each field of the scan; null: the field is
/// not needed. Throws Error (truncated, malformed) with the byte.
void readPackets(PagedFile& file, const Scan& scan, std::span<FieldValues* const> values);

} // namespace imgeo::e57
