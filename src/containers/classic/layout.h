#pragma once
// Sizes of the images of SIG classic.

#include "containers/limits.h"
#include "containers/png/png.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace imgeo {

/// Width of record images, and their maximum height with 16-bit indices: an index texel names the column by one byte
/// and the row by another.
inline constexpr std::uint32_t recordColumns = 256;

/// Width of index images, and of images with more records than 16-bit indices name, unless they would be more than
/// guaranteedImageEdge high.
inline constexpr std::uint32_t longColumns = 1024;

inline constexpr std::uint32_t rowsFor(std::uint64_t count, std::uint32_t columns) {
  return static_cast<std::uint32_t>((count + columns - 1) / columns);
}

struct ImageSize {
  std::uint32_t columns = 0, rows = 0;
};

/// The size of images of any number of texels: indices, and records without an index.
inline constexpr ImageSize longImageSize(std::uint64_t count) {
  const std::uint32_t columns = rowsFor(count, longColumns) <= guaranteedImageEdge ? longColumns : guaranteedImageEdge;
  return {columns, rowsFor(count, columns)};
}

/// The size of the images of so many records. Their height is a power of two, so that rows are whole steps of the row
/// byte and X3DOM does not scale the image.
inline constexpr ImageSize recordImageSize(std::uint64_t recordCount) {
  ImageSize size{recordColumns, rowsFor(recordCount, recordColumns)};
  if (size.rows > recordColumns)
    size = longImageSize(recordCount);
  return {size.columns, std::bit_ceil(size.rows)};
}

/// The size of an image of normals of two numbers, which has two halves: twice the record image.
inline constexpr ImageSize pairImageSize(ImageSize records) {
  if (2 * records.rows <= guaranteedImageEdge)
    return {records.columns, 2 * records.rows};
  return {2 * records.columns, records.rows};
}

/// Makes an image: texel(n, out) writes texel n of the first `count`; the rest repeat the last.
template <typename Texel> Image imageOf(ImageSize size, std::uint32_t channels, std::size_t count, Texel texel) {
  const std::size_t texels = std::size_t{size.columns} * size.rows;
  Image image{size.columns, size.rows, channels, Bytes(texels * channels)};
  std::uint8_t* out = image.pixels.data();
  for (std::size_t n = 0; n < texels; ++n, out += channels) {
    if (n < count)
      texel(n, out);
    else
      std::copy_n(out - channels, channels, out);
  }
  return image;
}

} // namespace imgeo
