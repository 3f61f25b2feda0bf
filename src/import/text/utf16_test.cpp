#include "import/text/utf16.h"

#include <gtest/gtest.h>
#include <string>
#include <string_view>

namespace imgeo {
namespace {

/// The bytes of UTF-16 units, with a byte order mark.
Bytes bytesOf(std::u16string_view text, bool isLittle) {
  Bytes bytes;
  const auto add = [&](char16_t unit) {
    const auto low = static_cast<std::uint8_t>(unit & 0xff), high = static_cast<std::uint8_t>(unit >> 8);
    bytes.insert(bytes.end(), {isLittle ? low : high, isLittle ? high : low});
  };
  add(0xfeff);
  for (const char16_t unit : text)
    add(unit);
  return bytes;
}

std::string utf8Of(ByteSpan bytes) {
  const auto text = utf8OfUtf16(bytes);
  return text ? std::string(asText(*text)) : "none";
}

TEST(Utf16, BecomesUtf8InBothByteOrders) {
  for (const bool isLittle : {true, false}) {
    EXPECT_EQ(utf8Of(bytesOf(u"v 1 2 3\n", isLittle)), "v 1 2 3\n");
    EXPECT_EQ(utf8Of(bytesOf(u"\u00fc \u20ac \U0001f600", isLittle)), "\xc3\xbc \xe2\x82\xac \xf0\x9f\x98\x80");
    EXPECT_EQ(utf8Of(bytesOf(u"", isLittle)), "");
  }
}

TEST(Utf16, UnpairedSurrogatesAreReplacedAndAnOddByteIsDropped) {
  const char16_t unpaired[] = {u'a', 0xd800, u'b', 0xdc00, 0xd801};
  Bytes bytes = bytesOf({unpaired, 5}, true);
  bytes.push_back('x');
  EXPECT_EQ(utf8Of(bytes), "a\xef\xbf\xbd"
                           "b\xef\xbf\xbd\xef\xbf\xbd");
}

TEST(Utf16, OtherTextsAreNotTouched) {
  for (const std::string_view text : {"", "v", "ply\n", "\xef\xbb\xbfply\n", "\xff"})
    EXPECT_EQ(utf8OfUtf16(asBytes(text)), std::nullopt);
}

} // namespace
} // namespace imgeo
