#include "containers/webp/webp.h"

#include "base/error.h"
#include "containers/limits.h"

#include <algorithm>
#include <string_view>
#include <webp/decode.h>

namespace imgeo {

namespace {

// A file is "RIFF", size, "WEBP", and one chunk: "VP8L", size, signature byte, header of 32 bits, data.
constexpr std::size_t formatOffset = 8, chunkOffset = 12, bitstreamOffset = 20, headerEnd = bitstreamOffset + 5;
constexpr std::uint8_t losslessSignature = 0x2f;

std::string_view nameAt(ByteSpan bytes, std::size_t offset) {
  return asText(bytes.subspan(offset, 4));
}

/// Checks that the bytes are one whole file of the simple lossless format.
void checkFile(ByteSpan bytes, const std::string& location) {
  if (!isWebp(bytes))
    throw Error(ErrorKind::malformed, location, "is no WebP image");
  if (bytes.size() < headerEnd)
    throw Error(ErrorKind::truncated, location, "the WebP image ends inside its header");
  const std::string_view chunk = nameAt(bytes, chunkOffset);
  if (chunk == "VP8 ")
    throw Error(ErrorKind::unsupported, location,
                "is a lossy WebP image; vertex data must be PNG or lossless WebP, which keep every byte");
  if (chunk != "VP8L")
    throw Error(ErrorKind::unsupported, location,
                "is a WebP image of the extended format; images of vertex data have the simple one");
  const std::uint64_t chunkSize = loadLittle<std::uint32_t>(&bytes[chunkOffset + 4]);
  const std::uint64_t fileSize = bitstreamOffset + chunkSize + chunkSize % 2; // chunks are padded to even sizes
  if (fileSize > bytes.size())
    throw Error(ErrorKind::truncated, location, "the WebP image ends before its data");
  if (fileSize < bytes.size() || loadLittle<std::uint32_t>(&bytes[4]) != fileSize - formatOffset)
    throw Error(ErrorKind::malformed, location, "the WebP image has a size that its header does not state");
}

} // namespace

bool isWebp(ByteSpan bytes) {
  return bytes.size() >= chunkOffset && nameAt(bytes, 0) == "RIFF" && nameAt(bytes, formatOffset) == "WEBP";
}

Image decodeWebp(ByteSpan bytes, const std::string& location) {
  checkFile(bytes, location);
  // 14 bits each of width - 1 and height - 1, a bit that says whether alpha is used, 3 bits of version.
  const std::uint32_t header = loadLittle<std::uint32_t>(&bytes[bitstreamOffset + 1]);
  if (bytes[bitstreamOffset] != losslessSignature || header >> 29 != 0)
    throw Error(ErrorKind::malformed, location, "is no lossless WebP image that readers know");
  const std::uint32_t width = 1 + (header & 0x3fff), height = 1 + (header >> 14 & 0x3fff);
  if (std::max(width, height) > maxImageEdge)
    throw Error(ErrorKind::limit, location,
                "the image is " + std::to_string(width) + " x " + std::to_string(height) + " texels large; at most " +
                    std::to_string(maxImageEdge) + " a side are read");
  Image image{width, height, 4, Bytes(std::size_t{4} * width * height)};
  const int stride = static_cast<int>(4 * width);
  if (WebPDecodeRGBAInto(bytes.data(), bytes.size(), image.pixels.data(), image.pixels.size(), stride) == nullptr)
    throw Error(ErrorKind::malformed, location, "the WebP image does not decode");
  return image;
}

} // namespace imgeo
