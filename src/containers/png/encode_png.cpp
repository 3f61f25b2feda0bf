#include "containers/limits.h"
#include "containers/png/filters.h"
#include "containers/png/png.h"

#include "base/narrow.h"

#include <cassert>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <span>

namespace imgeo {

namespace {

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

Compressor compressorOf(int level) {
  Compressor compressor(libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor)
    throw std::bad_alloc();
  return compressor;
}

Bytes deflate(ByteSpan bytes, libdeflate_compressor* compressor) {
  Bytes out(libdeflate_zlib_compress_bound(compressor, bytes.size()));
  out.resize(libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), out.data(), out.size()));
  assert(!out.empty());
  return out;
}

struct Effort {
  int level, levelOfLarge; ///< libdeflate's, 0 .. 12; time grows with size, so large images may get less
  int probeLevel;          ///< for choosing among the filters
  std::span<const Filter> filters;
};

/// Records of a patch fill no more than this; what is larger holds indices.
constexpr std::size_t largeImageBytes = 256 * 256 * 4;

/// Measured in docs/decisions/png-effort.md. Neighbours in the images of a mesh
/// stand side by side, hardly ever above one another: sub nearly always wins.
Effort effortOf(int effort) {
  assert(effort >= 0 && effort <= 9);
  static constexpr Filter all[] = {Filter::sub,      Filter::none, Filter::paeth,
                                   Filter::adaptive, Filter::up,   Filter::average};
  static constexpr std::span<const Filter> filters(all);
  static const Effort ladder[] = {
      {1, 1, 1, filters.first(1)},   {1, 1, 1, filters.first(2)},   {4, 4, 1, filters.first(2)},
      {6, 6, 1, filters.first(3)},   {7, 7, 1, filters.first(4)},   {10, 7, 1, filters.first(4)},
      {10, 10, 1, filters.first(4)}, {11, 11, 1, filters.first(4)}, {12, 12, 1, filters.first(4)},
      {12, 12, 12, filters},
  };
  return ladder[effort];
}

/// The filtered rows that deflate smallest at the probe level; the first of equals.
Bytes smallestRows(const Image& image, const Effort& effort) {
  if (effort.filters.size() == 1)
    return filterRows(image, effort.filters[0]);
  const Compressor probe = compressorOf(effort.probeLevel);
  Bytes best;
  std::size_t bestSize = SIZE_MAX;
  for (const Filter filter : effort.filters) {
    Bytes rows = filterRows(image, filter);
    const std::size_t size = deflate(rows, probe.get()).size();
    if (size >= bestSize)
      continue;
    bestSize = size;
    best = std::move(rows);
  }
  return best;
}

void appendChunk(Bytes& png, std::string_view type, ByteSpan data) {
  appendBig(png, narrow<std::uint32_t>(data.size()));
  const std::size_t from = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  appendBig(png, libdeflate_crc32(0, png.data() + from, png.size() - from));
}

/// A PNG whose rows are filtered, to be deflated at a level.
Bytes pngOf(const Image& image, const Bytes& rows, int level) {
  Bytes header;
  appendBig(header, image.width);
  appendBig(header, image.height);
  assert(image.palette.empty() || (image.channels == 1 && image.palette.size() <= 256 * 3));
  const std::uint8_t colorType = !image.palette.empty() ? 3
                                 : image.channels == 1  ? 0
                                 : image.channels == 3  ? 2
                                                        : 6;
  header.insert(header.end(), {8, colorType, 0, 0, 0}); // depth; deflate, adaptive filters, not interlaced

  const Bytes data = deflate(rows, compressorOf(level).get());
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  png.reserve(png.size() + 4 * 12 + header.size() + image.palette.size() + data.size());
  appendChunk(png, "IHDR", header);
  if (!image.palette.empty())
    appendChunk(png, "PLTE", image.palette);
  appendChunk(png, "IDAT", data);
  appendChunk(png, "IEND", {});
  return png;
}

[[maybe_unused]] bool isEncodable(const Image& image) {
  return image.width > 0 && image.width <= maxImageEdge && image.height > 0 && image.height <= maxImageEdge &&
         (image.channels == 1 || image.channels == 3 || image.channels == 4) &&
         image.pixels.size() == std::size_t{image.width} * image.height * image.channels;
}

} // namespace

Bytes encodePng(const Image& image, int effort) {
  assert(isEncodable(image));
  const Effort search = effortOf(effort);
  const int level = image.pixels.size() > largeImageBytes ? search.levelOfLarge : search.level;
  return pngOf(image, smallestRows(image, search), level);
}

Bytes encodePlainPng(const Image& image) {
  assert(isEncodable(image));
  return pngOf(image, filterRows(image, Filter::none), 1);
}

} // namespace imgeo
