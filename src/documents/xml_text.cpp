#include "documents/xml_text.h"

#include <algorithm>
#include <cstdint>

namespace imgeo {

namespace {

constexpr char32_t replacement = 0xfffd;

struct Range {
  char32_t first, last;
};

template <std::size_t N> bool isIn(const Range (&ranges)[N], char32_t c) {
  return std::ranges::any_of(ranges, [c](Range range) { return c >= range.first && c <= range.last; });
}

/// XML 1.0 (fifth edition), production [2] Char, without the control characters and noncharacters that its note
/// discourages, which HTML parsers replace, and U+0085.
bool isDocumentCharacter(char32_t c) {
  static constexpr Range ranges[] = {{0x9, 0xa},       {0xd, 0xd},       {0x20, 0x7e},       {0xa0, 0xd7ff},
                                     {0xe000, 0xfdcf}, {0xfdf0, 0xfffd}, {0x10000, 0x10ffff}};
  return isIn(ranges, c) && (c & 0xfffe) != 0xfffe;
}

/// Productions [4] NameStartChar and [4a] NameChar, without the colon of namespaces.
bool startsName(char32_t c) {
  static constexpr Range ranges[] = {{'A', 'Z'},       {'_', '_'},       {'a', 'z'},        {0xc0, 0xd6},
                                     {0xd8, 0xf6},     {0xf8, 0x2ff},    {0x370, 0x37d},    {0x37f, 0x1fff},
                                     {0x200c, 0x200d}, {0x2070, 0x218f}, {0x2c00, 0x2fef},  {0x3001, 0xd7ff},
                                     {0xf900, 0xfdcf}, {0xfdf0, 0xfffc}, {0x10000, 0xeffff}};
  return isIn(ranges, c);
}
bool continuesName(char32_t c) {
  static constexpr Range ranges[] = {{'-', '.'}, {'0', '9'}, {0xb7, 0xb7}, {0x300, 0x36f}, {0x203f, 0x2040}};
  return startsName(c) || isIn(ranges, c);
}

/// Decodes the character at `at` and advances `at`. Returns U+FFFD and advances by one byte if there is no valid UTF-8
/// (RFC 3629: shortest forms only, no surrogates).
char32_t decodeUtf8(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t lead = byte(at++);
  if (lead < 0x80)
    return lead;
  const std::size_t continuationBytes = lead >= 0xc2 && lead < 0xe0   ? 1
                                        : lead >= 0xe0 && lead < 0xf0 ? 2
                                        : lead >= 0xf0 && lead < 0xf5 ? 3
                                                                      : 0;
  if (continuationBytes == 0 || text.size() - at < continuationBytes)
    return replacement;
  char32_t c = lead & (0x3f >> continuationBytes);
  for (std::size_t i = 0; i < continuationBytes; ++i) {
    if ((byte(at + i) & 0xc0) != 0x80)
      return replacement;
    c = c << 6 | (byte(at + i) & 0x3f);
  }
  const char32_t minimum[] = {0, 0x80, 0x800, 0x10000};
  if (c < minimum[continuationBytes] || !isDocumentCharacter(c))
    return replacement;
  at += continuationBytes;
  return c;
}

void appendUtf8(std::string& out, char32_t c) {
  const auto append = [&](char32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (c < 0x80)
    return append(c);
  const int continuationBytes = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
  append((0xff80u >> continuationBytes & 0xff) | c >> (6 * continuationBytes));
  for (int i = continuationBytes - 1; i >= 0; --i)
    append(0x80 | (c >> (6 * i) & 0x3f));
}

/// Replaces each character for which substituteFor(c) is not null by that text.
template <typename Substitute> std::string substitute(std::string_view text, Substitute substituteFor) {
  std::string out;
  for (const char c : text) {
    if (const char* instead = substituteFor(c))
      out += instead;
    else
      out += c;
  }
  return out;
}

/// The entity reference of a character that begins or ends markup; null for other characters.
const char* entityReference(char c) {
  switch (c) {
  case '&':
    return "&amp;";
  case '<':
    return "&lt;";
  case '>':
    return "&gt;";
  default:
    return nullptr;
  }
}

/// An XML name in which underscores replace all characters that are not allowed.
std::string xmlName(std::string_view text) {
  std::string name;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = decodeUtf8(text, at);
    if (name.empty() && continuesName(c) && !startsName(c))
      name.push_back('_');
    appendUtf8(name, continuesName(c) && c != replacement ? c : U'_');
  }
  return name;
}

} // namespace

std::string validText(std::string_view text) {
  std::string valid;
  for (std::size_t at = 0; at < text.size();) {
    const char32_t c = decodeUtf8(text, at);
    appendUtf8(valid, isDocumentCharacter(c) ? c : replacement);
  }
  return valid;
}

std::string escapeText(std::string_view text) {
  return substitute(validText(text), entityReference);
}

std::string quoteAttribute(std::string_view text) {
  const std::string valid = validText(text);
  const char quote = valid.find('"') != std::string::npos && valid.find('\'') == std::string::npos ? '\'' : '"';
  return quote +
         substitute(valid,
                    [quote](char c) {
                      switch (c) {
                      case '"':
                        return quote == '"' ? "&quot;" : nullptr;
                      case '\t':
                        return "&#9;";
                      case '\n':
                        return "&#10;";
                      case '\r':
                        return "&#13;";
                      default:
                        return entityReference(c);
                      }
                    }) +
         quote;
}

std::string DefNames::take(std::string_view requested) {
  const std::string valid = xmlName(requested);
  if (valid.empty())
    return "";
  std::string name = valid;
  while (!next_.try_emplace(name, 2).second)
    name = valid + "_" + std::to_string(next_[valid]++);
  return name;
}

} // namespace imgeo
