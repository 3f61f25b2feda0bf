#pragma once
// PNG's row filters (ISO/IEC 15948, clause 9): each byte minus a prediction from
// the bytes to the left, above, and above left of it.

#include "containers/png/png.h"

namespace imgeo {

/// Values are PNG's filter types; `adaptive` chooses one of them for each row,
/// that of the smallest sum of absolute signed differences (clause 12.8).
enum class Filter : std::uint8_t { none = 0, sub = 1, up = 2, average = 3, paeth = 4, adaptive = 5 };

/// The filtered rows of an image as IDAT holds them: a filter type, then the
/// differences, row by row.
Bytes filterRows(const Image& image, Filter filter);

} // namespace imgeo
