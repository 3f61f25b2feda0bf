#include "import/text/text_scanner.h"

#include "scene/testing.h"

#include <bit>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>

namespace imgeo::testing {
namespace {

const std::string sourceName = "m.txt";

float float32Of(std::string_view text) {
  return TextScanner(asBytes(text), sourceName).float32("a number");
}
double float64Of(std::string_view text) {
  return TextScanner(asBytes(text), sourceName).float64("a number");
}

TEST(TextScanner, ReadsEveryFloatExactly) {
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const float value = std::bit_cast<float>(random.bits());
    if (std::isnan(value))
      continue;
    EXPECT_EQ(std::bit_cast<std::uint32_t>(float32Of(fmt::format("{}", value))), std::bit_cast<std::uint32_t>(value));
  }
}

TEST(TextScanner, ReadsNumbersAsProgramsWriteThem) {
  EXPECT_EQ(float32Of("+2.5e+1"), 25);
  EXPECT_EQ(float32Of("-.5"), -0.5f);
  EXPECT_EQ(float32Of("1."), 1);
  EXPECT_EQ(float32Of("1E3 "), 1000);
  EXPECT_TRUE(std::isnan(float32Of("-nan")));
  EXPECT_EQ(TextScanner(asBytes("+17/3"), sourceName).integer("an index"), 17);
}

TEST(TextScanner, RoundsTooSmallNumbersToZeroAndTooLargeOnesToInfinity) {
  EXPECT_EQ(float32Of("1e-60"), 0);
  EXPECT_EQ(float32Of("-1e-999"), 0);
  EXPECT_EQ(float32Of("1e39"), std::numeric_limits<float>::infinity());
  EXPECT_EQ(float64Of("-1e999"), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(float64Of("0." + std::string(400, '0') + "1"), 0);
  EXPECT_EQ(float64Of(std::string(400, '9')), std::numeric_limits<double>::infinity());
  EXPECT_EQ(float64Of(std::string(400, '9') + "e-400"), 1); // within range in spite of its many digits
}

TEST(TextScanner, RefusesWordsThatAreNotNumbers) {
  for (const char* text : {"", "x", "1x", "--1", "1,5", "0x10", "1e", "+-1", "\n"})
    EXPECT_THROW(float32Of(text), Error) << text;
}

TEST(TextScanner, ContinuesALineAfterABackslash) {
  TextScanner scanner(asBytes("a \\\r\n b\\\n c \\d\n"), sourceName);
  for (const char* word : {"a", "b\\"}) {
    scanner.skipBlanks();
    EXPECT_EQ(scanner.word(), word);
  }
}

TEST(TextScanner, NamesTheLine) {
  TextScanner scanner(asBytes("one\ntwo\r\n\nfour"), sourceName);
  EXPECT_EQ(scanner.location(), "m.txt:1");
  scanner.skipLine();
  EXPECT_EQ(scanner.location(), "m.txt:2");
  EXPECT_EQ(scanner.restOfLine(), "two");
  scanner.skipSpace();
  EXPECT_EQ(scanner.word(), "four");
  EXPECT_EQ(scanner.location(), "m.txt:4");
  EXPECT_TRUE(scanner.atEnd());
}

TEST(TextScanner, ShortensWordsToPrintableCharacters) {
  EXPECT_EQ(asPrintable("a\x01\xff z"), "a?? z");
  EXPECT_EQ(asPrintable(std::string(1000, 'x')), std::string(40, 'x') + "…");
}

} // namespace
} // namespace imgeo::testing
