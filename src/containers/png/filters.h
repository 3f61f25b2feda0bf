#pragma once
// PNG's row filters (ISO/IEC 15948, clause 9). They replace each byte by its difference from a prediction, made from
// the bytes to the left, above, and above left of it.

#include "containers/png/png.h"

namespace imgeo {

/// Values are PNG's filter types, except for `adaptive`: it chooses for each row the filter with the smallest sum of
/// absolute signed differences (clause 12.8).
enum class RowFilter : std::uint8_t { none = 0, sub = 1, up = 2, average = 3, paeth = 4, adaptive = 5 };

/// Filters an image: each row becomes a filter type and the differences.
Bytes filterRows(const Image& image, RowFilter filter);

/// Reverses the filters: fills `image.pixels` from (width * channels + 1) * height bytes. False if a row states an
/// unknown filter.
bool unfilterRows(ByteSpan filtered, Image& image);

} // namespace imgeo
