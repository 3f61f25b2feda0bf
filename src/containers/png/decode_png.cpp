#include "containers/limits.h"
#include "containers/png/png.h"

#include "base/error.h"

#include <algorithm>
#include <memory>
#include <new>
#include <spng.h>

namespace imgeo {

namespace {

struct Source {
  ByteSpan bytes;
  std::size_t at = 0;
  bool ended = false; ///< more was asked for than there is (libspng forgives a missing last check sum)
};

int readSource(spng_ctx*, void* user, void* out, std::size_t size) {
  Source& source = *static_cast<Source*>(user);
  if (source.bytes.size() - source.at < size) {
    source.ended = true;
    return SPNG_IO_EOF;
  }
  std::copy_n(source.bytes.data() + source.at, size, static_cast<std::uint8_t*>(out));
  source.at += size;
  return 0;
}

ErrorKind kindOf(int spngError) {
  switch (spngError) {
  case SPNG_IO_EOF:
    return ErrorKind::truncated;
  case SPNG_EUSER_WIDTH:
  case SPNG_EUSER_HEIGHT:
  case SPNG_ECHUNK_LIMITS:
    return ErrorKind::limit;
  default:
    return ErrorKind::malformed;
  }
}

void check(int spngError, const std::string& place) {
  if (spngError == SPNG_EMEM)
    throw std::bad_alloc();
  if (spngError != SPNG_OK)
    throw Error(kindOf(spngError), place, std::string("not a readable PNG: ") + spng_strerror(spngError));
}

std::uint32_t channelsOf(const spng_ihdr& header, const std::string& place) {
  if (header.bit_depth != 8 || header.interlace_method != SPNG_INTERLACE_NONE)
    throw Error(ErrorKind::unsupported, place, "data images have 8 bits a channel and are not interlaced");
  switch (header.color_type) {
  case SPNG_COLOR_TYPE_GRAYSCALE:
  case SPNG_COLOR_TYPE_INDEXED:
    return 1;
  case SPNG_COLOR_TYPE_TRUECOLOR:
    return 3;
  case SPNG_COLOR_TYPE_TRUECOLOR_ALPHA:
    return 4;
  default:
    throw Error(ErrorKind::unsupported, place, "data images are gray, RGB, RGBA or of a palette");
  }
}

/// The RGB image that a palette makes of its indices, as a browser expands it.
Image expanded(const Image& indices, spng_ctx* context, const std::string& place) {
  spng_trns transparency;
  if (spng_get_trns(context, &transparency) == SPNG_OK)
    throw Error(ErrorKind::unsupported, place, "the palette of a data image has no transparent entries");
  spng_plte palette;
  check(spng_get_plte(context, &palette), place);
  Image image{indices.width, indices.height, 3, {}};
  image.pixels.reserve(indices.pixels.size() * 3);
  for (const std::uint8_t index : indices.pixels) {
    if (index >= palette.n_entries)
      throw Error(ErrorKind::malformed, place, "a pixel names an entry that the palette does not have");
    const spng_plte_entry& entry = palette.entries[index];
    image.pixels.insert(image.pixels.end(), {entry.red, entry.green, entry.blue});
  }
  return image;
}

} // namespace

Image decodePng(ByteSpan bytes, const std::string& place) {
  const std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)> context(spng_ctx_new(0), &spng_ctx_free);
  if (!context)
    throw std::bad_alloc();
  Source source{bytes};
  check(spng_set_png_stream(context.get(), readSource, &source), place);
  check(spng_set_image_limits(context.get(), maxImageEdge, maxImageEdge), place);
  check(spng_set_chunk_limits(context.get(), bytes.size(), bytes.size()), place);
  check(spng_set_crc_action(context.get(), SPNG_CRC_ERROR, SPNG_CRC_ERROR), place);

  spng_ihdr header;
  check(spng_get_ihdr(context.get(), &header), place);
  Image image{header.width, header.height, channelsOf(header, place), {}};
  const std::uint64_t rowBytes = std::uint64_t{image.width} * image.channels;
  if ((rowBytes + 1) * image.height > bytes.size() * maxDeflateRatio)
    throw Error(ErrorKind::truncated, place, "the file is too short for the size its header states");

  image.pixels.resize(rowBytes * image.height);
  check(spng_decode_image(context.get(), image.pixels.data(), image.pixels.size(), SPNG_FMT_RAW, 0), place);
  check(spng_decode_chunks(context.get()), place); // reads on to IEND
  if (source.ended)
    throw Error(ErrorKind::truncated, place, "the PNG's last bytes are missing");
  if (source.at != bytes.size())
    throw Error(ErrorKind::malformed, place, "bytes follow the end of the PNG");
  return header.color_type == SPNG_COLOR_TYPE_INDEXED ? expanded(image, context.get(), place) : image;
}

} // namespace imgeo
