#include "containers/compact/payload_image.h"

#include "base/error.h"
#include "containers/limits.h"
#include "containers/png/png.h"

#include <algorithm>
#include <cassert>

namespace imgeo::compact {

static_assert(maxPayloadBytes == std::size_t{maxImageEdge} * maxImageEdge);

Bytes imageOfPayload(ByteSpan payload) {
  assert(!payload.empty() && payload.size() <= maxPayloadBytes);
  // The image has as few rows as possible, since each has a filter byte, and then the smallest width.
  const auto ceilDivide = [](std::size_t a, std::size_t b) { return static_cast<std::uint32_t>((a + b - 1) / b); };
  const std::uint32_t height = ceilDivide(payload.size(), maxImageEdge), width = ceilDivide(payload.size(), height);
  Image image{width, height, 1, Bytes(std::size_t{width} * height)};
  std::ranges::copy(payload, image.pixels.begin());
  return encodePlainPng(image);
}

Bytes payloadOfImage(ByteSpan png, const std::string& location) {
  Image image = decodePng(png, location);
  if (image.channels != 1)
    throw Error(ErrorKind::malformed, location, "images of compact are gray");
  return std::move(image.pixels);
}

} // namespace imgeo::compact
