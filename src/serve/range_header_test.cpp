#include "serve/range_header.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using Kind = ByteRange::Kind;

TEST(RangeHeader, TheThreeFormsOfARangeAreParsed) {
  EXPECT_EQ(parseRange("bytes=0-99", 1000), (ByteRange{Kind::partial, 0, 100}));
  EXPECT_EQ(parseRange("bytes=100-", 1000), (ByteRange{Kind::partial, 100, 900}));
  EXPECT_EQ(parseRange("bytes=-100", 1000), (ByteRange{Kind::partial, 900, 100}));
  EXPECT_EQ(parseRange(" bytes= 5-5 ", 1000), (ByteRange{Kind::partial, 5, 1}));
}

TEST(RangeHeader, ARangeIsClippedToTheFile) {
  EXPECT_EQ(parseRange("bytes=990-2000", 1000), (ByteRange{Kind::partial, 990, 10}));
  EXPECT_EQ(parseRange("bytes=-5000", 1000), (ByteRange{Kind::partial, 0, 1000}));
  EXPECT_EQ(parseRange("bytes=1-99999999999999999999999", 1000), (ByteRange{Kind::partial, 1, 999}));
}

TEST(RangeHeader, ARangeBeyondTheEndIsUnsatisfiable) {
  for (const char* header : {"bytes=1000-", "bytes=1000-1001", "bytes=-0", "bytes=99999999999999999999999-"})
    EXPECT_EQ(parseRange(header, 1000).kind, Kind::unsatisfiable) << header;
  EXPECT_EQ(parseRange("bytes=0-", 0).kind, Kind::unsatisfiable);
  EXPECT_EQ(parseRange("bytes=-1", 0).kind, Kind::unsatisfiable);
}

TEST(RangeHeader, MalformedAndMultipleRangesMeanTheWholeFile) {
  for (const char* header : {"", "bytes", "bytes=", "bytes=-", "bytes=a-b", "bytes=5-2", "bytes=1-2,4-5", "bytes=--5",
                             "bytes=+1-2", "lines=1-2", "bytes=1 - 2", "bytes=0x1-2", "bytes=1-2-3"})
    EXPECT_EQ(parseRange(header, 1000), (ByteRange{Kind::whole, 0, 1000})) << header;
}

TEST(RangeHeader, EveryPartialRangeLiesInsideTheFile) {
  for (std::uint64_t size = 0; size < 6; ++size) {
    for (int first = -1; first < 8; ++first) {
      for (int last = -1; last < 8; ++last) {
        const std::string header =
            fmt::format("bytes={}-{}", first < 0 ? "" : std::to_string(first), last < 0 ? "" : std::to_string(last));
        const ByteRange range = parseRange(header, size);
        if (range.kind != Kind::partial)
          continue;
        EXPECT_GT(range.count, 0u) << header;
        EXPECT_LE(range.first + range.count, size) << header;
      }
    }
  }
}

} // namespace
} // namespace imgeo
