#include "containers/limits.h"
#include "containers/png/filters.h"
#include "containers/png/png.h"

#include "base/narrow.h"

#include <algorithm>
#include <cassert>
#include <libdeflate.h>
#include <map>
#include <memory>
#include <new>
#include <span>

namespace imgeo {

namespace {

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

/// The compressor of libdeflate's level 0 .. 12. Each thread keeps the compressors it has used: allocating up to 9 MB
/// takes longer than deflating a small image.
libdeflate_compressor* compressorOf(int level) {
  thread_local std::map<int, Compressor> compressors;
  const auto found = compressors.find(level);
  if (found != compressors.end())
    return found->second.get();
  Compressor compressor(libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor)
    throw std::bad_alloc();
  return compressors.emplace(level, std::move(compressor)).first->second.get();
}

Bytes deflate(ByteSpan bytes, int level) {
  libdeflate_compressor* compressor = compressorOf(level);
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor, bytes.size());
  const auto out = std::make_unique_for_overwrite<std::uint8_t[]>(bound);
  const std::size_t size = libdeflate_zlib_compress(compressor, bytes.data(), bytes.size(), out.get(), bound);
  assert(size > 0);
  return Bytes(out.get(), out.get() + size);
}

/// How hard to compress. Levels are those of libdeflate, 0 .. 12; from 10 on it parses near-optimally.
struct Effort {
  int levelOfDense;        ///< for images with few repetitions: low bytes, normals
  int level, levelOfLarge; ///< for other images, where long matches slow parsing down
  std::span<const RowFilter> filters;
  int probeLevel = 1;                            ///< level at which filters are compared
  std::size_t probeBytes = std::size_t{1} << 15; ///< maximum size of the sample on which they are compared
};

/// Record images are at most this large; larger images hold indices.
constexpr std::size_t largeImageBytes = std::size_t{256} * 256 * 4;

/// Images that deflate below this ratio at the probe level count as repetitive.
constexpr double repetitiveRatio = 0.3;

/// Levels and filters of an effort of 0 .. 9, measured in docs/decisions/png-effort.md. Vertices that are close to each
/// other lie side by side in a row of an image, rarely in a column: sub is nearly always the best filter.
Effort effortOf(int effort) {
  assert(effort >= 0 && effort <= 9);
  static constexpr RowFilter all[] = {RowFilter::sub,      RowFilter::none, RowFilter::paeth,
                                      RowFilter::adaptive, RowFilter::up,   RowFilter::average};
  static constexpr std::span<const RowFilter> filters(all);
  static const Effort efforts[] = {
      {1, 1, 1, filters.first(1)},         {1, 1, 1, filters.first(2)},    {1, 4, 4, filters.first(2)},
      {1, 6, 6, filters.first(3)},         {1, 7, 7, filters.first(4)},    {10, 7, 7, filters.first(4)},
      {10, 10, 7, filters.first(4)},       {10, 10, 10, filters.first(4)}, {12, 12, 12, filters.first(4)},
      {12, 12, 12, filters, 12, SIZE_MAX},
  };
  return efforts[effort];
}

/// The image on which filters are compared: the whole image, or bands of rows spread evenly over it if it has more than
/// `bytes` bytes.
Image probeOf(const Image& image, std::size_t bytes) {
  if (image.pixels.size() <= bytes)
    return image;
  constexpr std::size_t bandCount = 4;
  const std::size_t rowBytes = std::size_t{image.width} * image.channels;
  const std::size_t bandRows = std::max<std::size_t>(1, bytes / (bandCount * rowBytes));
  Image probe{image.width, 0, image.channels, {}};
  for (std::size_t band = 0; band < bandCount; ++band) {
    const std::size_t first = (image.height - bandRows) * band / (bandCount - 1);
    const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(first * rowBytes);
    probe.pixels.insert(probe.pixels.end(), begin, begin + static_cast<std::ptrdiff_t>(bandRows * rowBytes));
  }
  probe.height = narrow<std::uint32_t>(bandCount * bandRows);
  return probe;
}

/// The result of probing an image.
struct Estimate {
  RowFilter filter; ///< with the smallest rows at the probe level; the first of equals
  bool isRepetitive = false;
};

Estimate estimate(const Image& image, const Effort& effort) {
  if (effort.filters.size() == 1)
    return {effort.filters[0]};
  const Image probe = probeOf(image, effort.probeBytes);
  RowFilter best = effort.filters[0];
  std::size_t bestSize = SIZE_MAX;
  for (const RowFilter filter : effort.filters) {
    const std::size_t size = deflate(filterRows(probe, filter), effort.probeLevel).size();
    if (size >= bestSize)
      continue;
    bestSize = size;
    best = filter;
  }
  return {best, static_cast<double>(bestSize) < repetitiveRatio * static_cast<double>(probe.pixels.size())};
}

void appendChunk(Bytes& png, std::string_view type, ByteSpan data) {
  appendBig(png, narrow<std::uint32_t>(data.size()));
  const std::size_t from = png.size();
  png.insert(png.end(), type.begin(), type.end());
  png.insert(png.end(), data.begin(), data.end());
  appendBig(png, libdeflate_crc32(0, png.data() + from, png.size() - from));
}

/// Makes a PNG of the zlib stream of an image's filtered rows.
Bytes pngOf(const Image& image, const Bytes& data) {
  Bytes header;
  appendBig(header, image.width);
  appendBig(header, image.height);
  assert(image.palette.empty() || (image.channels == 1 && image.palette.size() <= 256 * 3));
  const std::uint8_t colorType = !image.palette.empty() ? 3 : image.channels == 1 ? 0 : image.channels == 3 ? 2 : 6;
  header.insert(header.end(), {8, colorType, 0, 0, 0}); // depth; deflate, adaptive filters, not interlaced

  Bytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  png.reserve(png.size() + std::size_t{4} * 12 + header.size() + image.palette.size() + data.size());
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
  const auto [filter, isRepetitive] = estimate(image, search);
  const int level = !isRepetitive                           ? search.levelOfDense
                    : image.pixels.size() > largeImageBytes ? search.levelOfLarge
                                                            : search.level;
  return pngOf(image, deflate(filterRows(image, filter), level));
}

Bytes encodePlainPng(const Image& image) {
  assert(isEncodable(image));
  const Bytes rows = filterRows(image, RowFilter::none);
  const Bytes packed = deflate(rows, 1);
  // Stored bytes are faster to read than deflated ones, so they are used unless deflating saves 1/256.
  return pngOf(image, packed.size() + rows.size() / 256 < rows.size() ? packed : deflate(rows, 0));
}

} // namespace imgeo
