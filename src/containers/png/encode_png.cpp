#include "containers/limits.h"
#include "containers/png/filters.h"
#include "containers/png/png.h"

#include "base/narrow.h"

#include <cassert>
#include <initializer_list>
#include <libdeflate.h>
#include <memory>
#include <new>
#include <span>

namespace imgeo {

namespace {

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

Compressor compressorOf(int level) {
  Compressor compressor(libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  return compressor;
}

Bytes deflate(ByteSpan bytes, libdeflate_compressor* compressor) {
  Bytes out(libdeflate_zlib_compress_bound(compressor, bytes.size()));
  out.resize(libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), out.data(), out.size()));
  assert(!out.empty());
  return out;
}

struct Effort {
  int level;                        ///< libdeflate's, 0..12, for the file
  int probeLevel;                   ///< for choosing among the filters
  std::initializer_list<Filter> filters;
};

/// Measured in docs/decisions/png-effort.md.
Effort effortOf(int effort) {
  assert(effort >= 0 && effort <= 9);
  static const Effort ladder[] = {
      {1, 1, {Filter::none}},
      {1, 1, {Filter::none, Filter::sub}},
      {4, 1, {Filter::none, Filter::sub}},
      {6, 1, {Filter::none, Filter::sub, Filter::up}},
      {7, 1, {Filter::none, Filter::sub, Filter::up, Filter::paeth}},
      {8, 1, {Filter::none, Filter::sub, Filter::up, Filter::paeth, Filter::adaptive}},
      {9, 1, {Filter::none, Filter::sub, Filter::up, Filter::paeth, Filter::adaptive}},
      {10, 4, {Filter::none, Filter::sub, Filter::up, Filter::paeth, Filter::adaptive}},
      {12, 6, {Filter::none, Filter::sub, Filter::up, Filter::paeth, Filter::adaptive}},
      {12, 12, {Filter::none, Filter::sub, Filter::up, Filter::paeth, Filter::adaptive}},
  };
  return ladder[effort];
}

/// The filtered rows that deflate smallest at the probe level; the first of equals.
Bytes smallestRows(const Image& image, const Effort& effort) {
  if (effort.filters.size() == 1) return filterRows(image, *effort.filters.begin());
  const Compressor probe = compressorOf(effort.probeLevel);
  Bytes best;
  std::size_t bestSize = SIZE_MAX;
  for (const Filter filter : effort.filters) {
    Bytes rows = filterRows(image, filter);
    const std::size_t size = deflate(rows, probe.get()).size();
    if (size >= bestSize) continue;
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

} // namespace

Bytes encodePng(const Image& image, int effort) {
  assert(image.width > 0 && image.width <= maxImageEdge && image.height > 0 && image.height <= maxImageEdge);
  assert(image.channels == 1 || image.channels == 3 || image.channels == 4);
  assert(image.pixels.size() == std::size_t{image.width} * image.height * image.channels);

  Bytes header;
  appendBig(header, image.width);
  appendBig(header, image.height);
  const std::uint8_t colorType = image.channels == 1 ? 0 : image.channels == 3 ? 2 : 6;
  header.insert(header.end(), {8, colorType, 0, 0, 0}); // depth; deflate, adaptive filters, not interlaced

  const Effort search = effortOf(effort);
  const Bytes data = deflate(smallestRows(image, search), compressorOf(search.level).get());
  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  png.reserve(png.size() + 3 * 12 + header.size() + data.size());
  appendChunk(png, "IHDR", header);
  appendChunk(png, "IDAT", data);
  appendChunk(png, "IEND", {});
  return png;
}

} // namespace imgeo
