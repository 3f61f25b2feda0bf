#include "import/text/utf16.h"

namespace imgeo {

namespace {

constexpr std::uint32_t replacementCharacter = 0xfffd;

bool isHighSurrogate(std::uint32_t unit) {
  return unit >= 0xd800 && unit < 0xdc00;
}

bool isLowSurrogate(std::uint32_t unit) {
  return unit >= 0xdc00 && unit < 0xe000;
}

void appendUtf8(Bytes& text, std::uint32_t code) {
  const auto add = [&](std::uint32_t byte) { text.push_back(static_cast<std::uint8_t>(byte)); };
  if (code < 0x80) {
    add(code);
  } else if (code < 0x800) {
    add(0xc0 | code >> 6), add(0x80 | (code & 0x3f));
  } else if (code < 0x10000) {
    add(0xe0 | code >> 12), add(0x80 | (code >> 6 & 0x3f)), add(0x80 | (code & 0x3f));
  } else {
    add(0xf0 | code >> 18), add(0x80 | (code >> 12 & 0x3f)), add(0x80 | (code >> 6 & 0x3f)), add(0x80 | (code & 0x3f));
  }
}

} // namespace

std::optional<Bytes> utf8OfUtf16(ByteSpan bytes) {
  if (bytes.size() < 2)
    return std::nullopt;
  const bool isLittle = bytes[0] == 0xff && bytes[1] == 0xfe, isBig = bytes[0] == 0xfe && bytes[1] == 0xff;
  if (!isLittle && !isBig)
    return std::nullopt;
  const std::size_t unitCount = bytes.size() / 2;
  const auto unitAt = [&](std::size_t i) -> std::uint32_t {
    const std::uint32_t first = bytes[2 * i], second = bytes[2 * i + 1];
    return isLittle ? first | second << 8 : first << 8 | second;
  };
  Bytes text;
  text.reserve(unitCount);
  for (std::size_t i = 1; i < unitCount; ++i) {
    std::uint32_t code = unitAt(i);
    if (isHighSurrogate(code) && i + 1 < unitCount && isLowSurrogate(unitAt(i + 1)))
      code = 0x10000 + ((code - 0xd800) << 10) + (unitAt(++i) - 0xdc00);
    else if (isHighSurrogate(code) || isLowSurrogate(code))
      code = replacementCharacter;
    appendUtf8(text, code);
  }
  return text;
}

} // namespace imgeo
