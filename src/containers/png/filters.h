#pragma once
// PNG's row filters (ISO/IEC 15948, clause 9): each byte minus a prediction from
// the bytes to the left, above, and above left of it.

#include "containers/png/png.h"

namespace imgeo {

/// Values are PNG's filter types; `adaptive` chooses one of them for each row,
/// that of the smallest sum of absolute signed differences (clause 12.8).
enum class RowFilter : std::uint8_t { none = 0, sub = 1, up = 2, average = 3, paeth = 4, adaptive = 5 };

/// The filtered rows of an image as IDAT holds them: a filter type, then the
/// differences, row by row.
Bytes filterRows(const Image& image, RowFilter filter);

/// The other way around: makes `image.pixels` out of (width * channels + 1) * height bytes.
/// False where a row states a filter that there is not.
bool unfilterRows(ByteSpan filtered, Image& image);

} // namespace imgeo
