#include "images/image_type.h"

#include <algorithm>
#include <array>

namespace imgeo {

namespace {

bool has(std::string_view text, std::size_t at, std::string_view what) {
  return text.size() >= at && text.substr(at).starts_with(what);
}

bool isOneOf(unsigned value, std::initializer_list<unsigned> values) {
  return std::ranges::find(values, value) != values.end();
}

/// A BMP's second header begins with its own length.
bool isBmp(ByteSpan bytes) {
  constexpr std::size_t fileHeader = 14;
  return has(asText(bytes), 0, "BM") && bytes.size() >= fileHeader + 4 &&
         isOneOf(loadLittle<std::uint32_t>(&bytes[fileHeader]), {12, 16, 40, 52, 56, 64, 108, 124});
}

/// TGA has no signature at its beginning; few other files fit its header (Truevision TGA file format specification
/// 2.0).
bool isTga(ByteSpan bytes) {
  constexpr std::size_t header = 18;
  if (bytes.size() <= header)
    return false;
  const unsigned colorMap = bytes[1], kind = bytes[2], mapEntryBits = bytes[7], pixelBits = bytes[16];
  const bool isMapped = isOneOf(kind, {1, 9});
  const unsigned width = loadLittle<std::uint16_t>(&bytes[12]), height = loadLittle<std::uint16_t>(&bytes[14]);
  return colorMap <= 1 && isOneOf(kind, {1, 2, 3, 9, 10, 11}) && (!isMapped || colorMap == 1) &&
         (colorMap == 0 || isOneOf(mapEntryBits, {15, 16, 24, 32})) && isOneOf(pixelBits, {8, 15, 16, 24, 32}) &&
         width > 0 && height > 0;
}

bool isPcx(ByteSpan bytes) {
  return bytes.size() > 128 && bytes[0] == 0x0a && isOneOf(bytes[1], {0, 2, 3, 4, 5}) && bytes[2] == 1 &&
         isOneOf(bytes[3], {1, 2, 4, 8});
}

/// Portable any-map: "P5\n" …
bool isPnm(std::string_view text) {
  return text.size() > 2 && text[0] == 'P' && text[1] >= '1' && text[1] <= '6' &&
         (text[2] == '\n' || text[2] == ' ' || text[2] == '\r' || text[2] == '\t');
}

} // namespace

std::string imageType(ByteSpan bytes) {
  const std::string_view text = asText(bytes);
  if (has(text, 0, "\x89PNG\r\n\x1a\n"))
    return ".png";
  if (has(text, 0, "\xff\xd8\xff"))
    return ".jpg";
  if (has(text, 0, "RIFF") && has(text, 8, "WEBP"))
    return ".webp";
  if (has(text, 4, "ftypavif"))
    return ".avif";
  if (has(text, 0, "GIF8"))
    return ".gif";
  if (has(text, 0, {"II*\0", 4}) || has(text, 0, {"MM\0*", 4}))
    return ".tif";
  if (has(text, 0, "8BPS"))
    return ".psd";
  if (has(text, 0, "\x01\xda"))
    return ".sgi";
  if (isBmp(bytes))
    return ".bmp";
  if (isPcx(bytes))
    return ".pcx";
  if (isPnm(text))
    return ".pnm";
  return isTga(bytes) ? ".tga" : "";
}

bool isWebImageType(std::string_view type) {
  static constexpr std::array types{".png", ".jpg", ".webp", ".avif", ".gif"};
  return std::ranges::find(types, type) != types.end();
}

bool isDecodable(std::string_view type) {
  // A GIF may be animated, and GraphicsMagick in Debian 12 has no decoder for AVIF.
  return !type.empty() && type != ".gif" && type != ".avif";
}

} // namespace imgeo
