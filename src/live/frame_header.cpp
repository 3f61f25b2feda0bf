#include "live/frame.h"

#include "base/error.h"

#include <cmath>
#include <fmt/format.h>
#include <libdeflate.h>

namespace imgeo::live {

namespace {

/// Deflate writes at least one byte for 1032: a pair of 2 bits stands for 258.
constexpr std::uint64_t maxExpansion = 1032;

bool isBetween(std::uint32_t value, std::uint32_t min, std::uint32_t max) {
  return value >= min && value <= max;
}

bool hasValidRanges(const FrameLayout& layout) {
  return layout.vertices > 0 && (layout.columns == 0 || layout.vertices % layout.columns == 0) &&
         isBetween(layout.positionBits, 8, 24) && (layout.normalBits == 0 || isBetween(layout.normalBits, 8, 16)) &&
         (layout.colorComponents == 0 || isBetween(layout.colorComponents, 3, 4)) && layout.valueComponents <= 4 &&
         (layout.valueComponents == 0 ? layout.valueBits == 0 : isBetween(layout.valueBits, 8, 24));
}

} // namespace

std::vector<ComponentBits> attributesOf(const FrameLayout& layout) {
  std::vector<ComponentBits> attributes;
  std::uint32_t first = 0;
  const auto add = [&](std::uint32_t count, std::uint32_t bits) {
    if (count == 0)
      return;
    attributes.push_back({first, count, bits});
    first += count;
  };
  add(3, layout.positionBits);
  add(layout.normalBits > 0 ? 2 : 0, layout.normalBits);
  add(layout.colorComponents, 8);
  add(layout.valueComponents, layout.valueBits);
  return attributes;
}

std::uint32_t componentCount(const FrameLayout& layout) {
  return 3 + (layout.normalBits > 0 ? 2 : 0) + layout.colorComponents + layout.valueComponents;
}

std::uint64_t unpackedBytesOf(const FrameLayout& layout) {
  std::uint64_t bytes = 0;
  for (const ComponentBits& attribute : attributesOf(layout))
    bytes += std::uint64_t{attribute.count} * ((attribute.bits + 7) / 8);
  return bytes * layout.vertices;
}

void checkLayout(const FrameLayout& layout, const std::string& location) {
  if (!hasValidRanges(layout))
    throw Error(ErrorKind::malformed, location, "a field of the frame's header is out of its range");
  if (layout.vertices > maxFrameVertices || unpackedBytesOf(layout) > maxUnpackedBytes)
    throw Error(ErrorKind::limit, location,
                fmt::format("a frame of {} vertices is too large: at most {} vertices and {} bytes are read",
                            layout.vertices, maxFrameVertices, maxUnpackedBytes));
}

FrameHeader readFrameHeader(ByteSpan bytes, const std::string& location, FrameContext context) {
  if (bytes.size() < frameHeaderBytes)
    throw Error(ErrorKind::truncated, location, "the frame ends within its header");
  const std::uint8_t* at = bytes.data();
  if (asText(bytes.first(3)) != "IGF")
    throw Error(ErrorKind::malformed, location, "is no frame: it does not begin with IGF");
  if (at[3] != 1)
    throw Error(ErrorKind::unsupported, location, fmt::format("is a frame of version {}; only 1 is read", at[3]));
  if (loadLittle<std::uint32_t>(at + 48) != libdeflate_crc32(0, at, 48))
    throw Error(ErrorKind::malformed, location, "the checksum of the frame's header is wrong");

  FrameHeader header;
  header.packedBytes = loadLittle<std::uint32_t>(at + 4);
  header.number = loadLittle<std::uint64_t>(at + 8);
  header.epoch = loadLittle<std::uint64_t>(at + 16);
  header.time = loadLittle<double>(at + 24);
  header.layout = {
      loadLittle<std::uint32_t>(at + 32), loadLittle<std::uint32_t>(at + 36), at[40], at[41], at[42], at[43], at[44]};
  // docs/formats/sequence.md: the third bit of the prediction marks a difference.
  header.isDifference = context == FrameContext::sequence && (at[45] & differenceBit) != 0;
  const std::uint32_t prediction = at[45] - (header.isDifference ? differenceBit : 0);
  header.prediction = static_cast<Prediction>(prediction);
  const bool isPlanar = header.prediction == Prediction::planar;
  if (header.number > maxFrameNumber || header.epoch > header.number || !std::isfinite(header.time) || prediction > 3 ||
      (isPlanar && header.layout.columns == 0) || at[46] != 0 || at[47] != 0)
    throw Error(ErrorKind::malformed, location, "a field of the frame's header is out of its range");
  checkLayout(header.layout, location);

  const std::size_t rest = bytes.size() - frameHeaderBytes;
  if (rest < header.packedBytes)
    throw Error(ErrorKind::truncated, location,
                fmt::format("the frame is cut: it has {} bytes of {}", rest, header.packedBytes));
  if (rest > header.packedBytes)
    throw Error(ErrorKind::malformed, location, "bytes follow the frame");
  if (unpackedBytesOf(header.layout) > maxExpansion * header.packedBytes)
    throw Error(ErrorKind::malformed, location, "the frame has too few bytes for its vertices");
  return header;
}

} // namespace imgeo::live
