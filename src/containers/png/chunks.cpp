#include "containers/png/chunks.h"

#include "base/error.h"
#include "containers/limits.h"

#include <algorithm>
#include <array>
#include <libdeflate.h>
#include <optional>
#include <string_view>

namespace imgeo {

namespace {

constexpr std::uint8_t signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t headerLength = 13, chunkOverhead = 12; // length, type, checksum

struct Chunk {
  std::string_view type;
  ByteSpan data;
  std::uint32_t sum = 0;

  /// Whether a reader must know the chunk: its first letter is a capital.
  bool isCritical() const { return (type[0] & 32) == 0; }
};

/// Throws Errors of one location.
struct Refusal {
  const std::string& location;

  [[noreturn]] void operator()(ErrorKind kind, const std::string& message) const {
    throw Error(kind, location, message);
  }
  void unless(bool condition, ErrorKind kind, const char* message) const {
    if (!condition)
      (*this)(kind, message);
  }
};

/// The name of a format that hosts and image optimisers may serve instead of a PNG; empty: unknown.
std::string_view foreignFormatOf(ByteSpan bytes) {
  struct Format {
    std::string_view name;
    std::size_t offset;
    std::string_view magic;
  };
  static constexpr Format formats[] = {{"a JPEG image", 0, "\xff\xd8\xff"},
                                       {"a WebP image", 8, "WEBP"},
                                       {"an AVIF image", 4, "ftypavif"},
                                       {"a GIF image", 0, "GIF8"},
                                       {"a BMP image", 0, "BM"}};
  for (const Format& format : formats)
    if (bytes.size() >= format.offset && asText(bytes.subspan(format.offset)).starts_with(format.magic))
      return format.name;
  return {};
}

void checkSignature(ByteSpan png, const Refusal& refuse) {
  if (png.size() >= std::size(signature) && std::ranges::equal(png.first(std::size(signature)), signature))
    return;
  if (const std::string_view other = foreignFormatOf(png); !other.empty())
    refuse(ErrorKind::unsupported, "is " + std::string(other) + "; vertex data must be PNG, which keeps every byte");
  refuse(png.size() < std::size(signature) ? ErrorKind::truncated : ErrorKind::malformed, "is no PNG image");
}

/// All chunks in order; the last one is IEND, which ends the file.
std::vector<Chunk> splitChunks(ByteSpan png, const Refusal& refuse) {
  std::vector<Chunk> chunks;
  std::size_t at = std::size(signature);
  while (chunks.empty() || chunks.back().type != "IEND") {
    refuse.unless(png.size() - at >= chunkOverhead, ErrorKind::truncated, "the PNG ends before its last chunk");
    const std::size_t length = loadBig<std::uint32_t>(&png[at]);
    refuse.unless(length <= png.size() - at - chunkOverhead, ErrorKind::truncated, "the PNG ends inside a chunk");
    chunks.push_back(
        {asText(png.subspan(at + 4, 4)), png.subspan(at + 8, length), loadBig<std::uint32_t>(&png[at + 8 + length])});
    at += length + chunkOverhead;
  }
  refuse.unless(at == png.size(), ErrorKind::malformed, "bytes follow the end of the PNG");
  return chunks;
}

/// Requires IHDR first, at most one palette, consecutive IDAT chunks, and no other critical chunk.
void checkOrder(const std::vector<Chunk>& chunks, const Refusal& refuse) {
  refuse.unless(chunks[0].type == "IHDR" && chunks[0].data.size() == headerLength, ErrorKind::malformed,
                "does not begin with a PNG header");
  std::size_t palettes = 0, runs = 0;
  for (std::size_t i = 1; i < chunks.size(); ++i) {
    const Chunk& chunk = chunks[i];
    palettes += chunk.type == "PLTE";
    runs += chunk.type == "IDAT" && chunks[i - 1].type != "IDAT";
    refuse.unless(!chunk.isCritical() || chunk.type == "PLTE" || chunk.type == "IDAT" || chunk.type == "IEND",
                  ErrorKind::malformed, "the PNG has a chunk that no reader knows");
  }
  refuse.unless(runs > 0, ErrorKind::malformed, "the PNG holds no image data");
  refuse.unless(runs == 1 && palettes <= 1, ErrorKind::malformed, "the PNG's chunks are out of order");
  refuse.unless(std::ranges::find(chunks, "tRNS", &Chunk::type) == chunks.end(), ErrorKind::unsupported,
                "data images have no colours that are see-through");
}

PngChunks readHeader(ByteSpan header, const Refusal& refuse) {
  PngChunks png;
  png.width = loadBig<std::uint32_t>(&header[0]);
  png.height = loadBig<std::uint32_t>(&header[4]);
  const auto isEdge = [](std::uint32_t edge) { return edge >= 1 && edge <= maxImageEdge; };
  if (!isEdge(png.width) || !isEdge(png.height))
    refuse(ErrorKind::limit, "is " + std::to_string(png.width) + " x " + std::to_string(png.height) +
                                 " pixels large; 1 to " + std::to_string(maxImageEdge) + " are allowed");
  const std::uint8_t depth = header[8], colorType = header[9], compression = header[10], filter = header[11],
                     interlace = header[12];
  refuse.unless(depth == 8 && (colorType == 0 || colorType == 2 || colorType == 3 || colorType == 6),
                ErrorKind::unsupported, "data images are of 8 bits a channel, gray, RGB, RGBA or of a palette");
  refuse.unless(interlace == 0, ErrorKind::unsupported, "data images are not interlaced");
  refuse.unless(compression == 0 && filter == 0, ErrorKind::malformed,
                "the PNG has an unknown compression or filter method");
  png.isPalette = colorType == 3;
  png.channels = colorType == 2 ? 3 : colorType == 6 ? 4 : 1;
  return png;
}

/// The checksum of a chunk covers its type and its data.
void checkSum(const Chunk& chunk, const Refusal& refuse) {
  const auto* begin = reinterpret_cast<const std::uint8_t*>(chunk.type.data());
  if (libdeflate_crc32(0, begin, chunk.type.size() + chunk.data.size()) != chunk.sum)
    refuse(ErrorKind::malformed, "the PNG has a damaged chunk");
}

} // namespace

PngChunks readPngChunks(ByteSpan bytes, const std::string& location) {
  const Refusal refuse{location};
  checkSignature(bytes, refuse);
  const std::vector<Chunk> chunks = splitChunks(bytes, refuse);
  checkOrder(chunks, refuse);
  PngChunks png = readHeader(chunks[0].data, refuse);
  for (const Chunk& chunk : chunks) {
    checkSum(chunk, refuse);
    if (chunk.type == "IDAT")
      png.data.push_back(chunk.data);
    else if (chunk.type == "PLTE" && png.isPalette)
      png.palette = chunk.data;
  }
  const std::size_t size = png.palette.size();
  refuse.unless(!png.isPalette || (size > 0 && size <= std::size_t{3} * 256 && size % 3 == 0), ErrorKind::malformed,
                "the PNG has no palette of 1 to 256 colours");
  return png;
}

} // namespace imgeo
