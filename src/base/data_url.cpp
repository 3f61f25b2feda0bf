#include "base/data_url.h"

#include "base/error.h"

#include <array>
#include <fmt/format.h>

namespace imgeo {

namespace {

int hexDigit(char c) {
  return c >= '0' && c <= '9'   ? c - '0'
         : c >= 'a' && c <= 'f' ? c - 'a' + 10
         : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                : -1;
}

constexpr std::string_view base64Alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

} // namespace

std::string percentDecoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hexDigit(text[i + 1]) : -1,
              low = high >= 0 ? hexDigit(text[i + 2]) : -1;
    decoded += low >= 0 ? static_cast<char>(high * 16 + low) : text[i];
    i += low >= 0 ? 2 : 0;
  }
  return decoded;
}

Bytes base64Decoded(std::string_view text, const std::string& location) {
  static constexpr auto values = [] {
    std::array<std::int8_t, 256> table{};
    table.fill(-1);
    for (std::size_t i = 0; i < base64Alphabet.size(); ++i)
      table[static_cast<unsigned char>(base64Alphabet[i])] = static_cast<std::int8_t>(i);
    table['-'] = 62, table['_'] = 63; // the url-safe alphabet
    return table;
  }();
  Bytes decoded;
  decoded.reserve(text.size() / 4 * 3);
  std::uint32_t bits = 0, count = 0;
  for (const char c : text) {
    if (c == '=' || c == ' ' || c == '\n' || c == '\r' || c == '\t')
      continue;
    const std::int8_t value = values[static_cast<unsigned char>(c)];
    if (value < 0)
      throw Error(ErrorKind::malformed, location, "base64 data has an invalid character");
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      decoded.push_back(static_cast<std::uint8_t>(bits >> count));
    }
  }
  return decoded;
}

std::string dataUrlOf(ByteSpan bytes, std::string_view mediaType) {
  std::string url = fmt::format("data:{};base64,", mediaType);
  url.reserve(url.size() + bytes.size() / 3 * 4 + 4);
  std::uint32_t bits = 0, count = 0;
  for (const std::uint8_t byte : bytes) {
    bits = bits << 8 | byte;
    for (count += 8; count >= 6; count -= 6)
      url += base64Alphabet[bits >> (count - 6) & 63];
  }
  if (count > 0)
    url += base64Alphabet[bits << (6 - count) & 63];
  url.append((3 - bytes.size() % 3) % 3, '=');
  return url;
}

Bytes bytesOfDataUrl(std::string_view url, const std::string& location) {
  const std::size_t comma = url.find(',');
  if (comma == url.npos)
    throw Error(ErrorKind::malformed, location, "a data: url has no comma");
  const std::string_view data = url.substr(comma + 1);
  if (url.substr(0, comma).ends_with(";base64"))
    return base64Decoded(data, location);
  const std::string text = percentDecoded(data);
  return Bytes(text.begin(), text.end());
}

} // namespace imgeo
