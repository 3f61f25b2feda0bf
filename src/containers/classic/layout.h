#pragma once
// How records and indices lie in the images of SIG classic.

#include <bit>
#include <cstdint>

namespace imgeo {

/// Width of the images that hold records, and their largest height: an index
/// texel names the column by one byte and the row by another.
inline constexpr std::uint32_t recordColumns = 256;

/// Width of index images, until they would be more than guaranteedImageEdge high.
inline constexpr std::uint32_t indexColumns = 1024;

inline constexpr std::uint32_t rowsFor(std::uint64_t count, std::uint32_t columns) {
  return static_cast<std::uint32_t>((count + columns - 1) / columns);
}

/// Height of the images that hold so many records: a power of two, so that
/// rows are whole steps of the row byte and X3DOM takes the image unscaled.
inline constexpr std::uint32_t recordRows(std::uint32_t vertexCount) {
  return std::bit_ceil(rowsFor(vertexCount, recordColumns));
}

} // namespace imgeo
