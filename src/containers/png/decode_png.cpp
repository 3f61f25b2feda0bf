#include "containers/limits.h"
#include "containers/png/chunks.h"
#include "containers/png/filters.h"
#include "containers/png/png.h"

#include "base/error.h"

#include <libdeflate.h>
#include <memory>
#include <new>

namespace imgeo {

namespace {

/// Unpacks a zlib stream in several pieces, whose contents must have exactly `size` bytes.
Bytes inflate(const std::vector<ByteSpan>& pieces, std::size_t size, const std::string& location) {
  Bytes joined;
  ByteSpan packed = pieces[0];
  if (pieces.size() > 1) {
    for (const ByteSpan piece : pieces)
      joined.insert(joined.end(), piece.begin(), piece.end());
    packed = joined;
  }
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), &libdeflate_free_decompressor);
  if (!decompressor)
    throw std::bad_alloc();
  Bytes out(size);
  std::size_t taken = 0, given = 0;
  const libdeflate_result result = libdeflate_zlib_decompress_ex(decompressor.get(), packed.data(), packed.size(),
                                                                 out.data(), out.size(), &taken, &given);
  if (result == LIBDEFLATE_INSUFFICIENT_SPACE)
    throw Error(ErrorKind::malformed, location, "the PNG holds more than its pixels");
  if (result != LIBDEFLATE_SUCCESS || taken != packed.size())
    throw Error(ErrorKind::malformed, location, "the PNG's data does not unpack");
  if (given < size)
    throw Error(ErrorKind::truncated, location, "the PNG does not hold all of its pixels");
  return out;
}

/// Expands palette indices to RGB.
Image expanded(const Image& indices, ByteSpan palette, const std::string& location) {
  Image image{indices.width, indices.height, 3, {}};
  image.pixels.reserve(indices.pixels.size() * 3);
  for (const std::uint8_t index : indices.pixels) {
    const std::size_t entry = std::size_t{3} * index;
    if (entry >= palette.size())
      throw Error(ErrorKind::malformed, location, "a pixel names an entry that the palette does not have");
    image.pixels.insert(image.pixels.end(), &palette[entry], &palette[entry] + 3);
  }
  return image;
}

} // namespace

Image decodePng(ByteSpan bytes, const std::string& location) {
  const PngChunks png = readPngChunks(bytes, location);
  const std::uint64_t rowBytes = std::uint64_t{png.width} * png.channels;
  const std::uint64_t filteredBytes = (rowBytes + 1) * png.height;
  if (filteredBytes > bytes.size() * maxDeflateRatio)
    throw Error(ErrorKind::truncated, location, "the file is too short for the size its header states");
  Image image{png.width, png.height, png.channels, {}};
  if (!unfilterRows(inflate(png.data, filteredBytes, location), image))
    throw Error(ErrorKind::malformed, location, "the PNG has a row of an unknown filter");
  return png.isPalette ? expanded(image, png.palette, location) : image;
}

} // namespace imgeo
