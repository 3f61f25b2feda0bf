#include "serve/content_coding.h"

#include "serve/coding_cache.h"

#include <brotli/decode.h>
#include <gtest/gtest.h>
#include <libdeflate.h>

namespace imgeo {
namespace {

TEST(ContentCoding, BrotliPrecedesGzipWhereBothAreAccepted) {
  EXPECT_EQ(chooseCoding("gzip, deflate, br, zstd"), ContentCoding::brotli);
  EXPECT_EQ(chooseCoding("gzip"), ContentCoding::gzip);
  EXPECT_EQ(chooseCoding("GZIP ; q=0.5 , BR;Q=0.5"), ContentCoding::brotli);
  EXPECT_EQ(chooseCoding("*"), ContentCoding::brotli);
}

TEST(ContentCoding, TheHigherQualityWins) {
  EXPECT_EQ(chooseCoding("br;q=0.5, gzip;q=0.8"), ContentCoding::gzip);
  EXPECT_EQ(chooseCoding("br;q=0.123, gzip;q=0.122"), ContentCoding::brotli);
  EXPECT_EQ(chooseCoding("gzip;q=0.5, identity"), ContentCoding::identity);
  EXPECT_EQ(chooseCoding("gzip;q=0.001"), ContentCoding::gzip);
}

TEST(ContentCoding, ForbiddenAndUnknownCodingsAreNotChosen) {
  for (const char* header : {"", ",", "br;q=0", "br;q=0.000, *;q=0", "zstd", "br;q=", "br;q=2", "br;q=1.x",
                             "br;q=0.1234567", "br;quality=1", "brotli", "b r", "deflate"})
    EXPECT_EQ(chooseCoding(header), ContentCoding::identity) << header;
  EXPECT_EQ(chooseCoding("br;q=0, *"), ContentCoding::gzip);
}

Bytes sampleText() {
  Bytes text;
  for (int i = 0; i < 20'000; ++i)
    text.push_back(static_cast<std::uint8_t>("<Shape DEF='x'>"[i * 7 % 15]));
  return text;
}

TEST(ContentCoding, BrotliDecodesToTheInput) {
  const Bytes text = sampleText(), packed = encodeContent(ContentCoding::brotli, text);
  Bytes unpacked(text.size());
  std::size_t size = unpacked.size();
  ASSERT_EQ(BrotliDecoderDecompress(packed.size(), packed.data(), &size, unpacked.data()),
            BROTLI_DECODER_RESULT_SUCCESS);
  EXPECT_EQ(size, text.size());
  EXPECT_EQ(unpacked, text);
  EXPECT_LT(packed.size(), text.size() / 10);
}

TEST(ContentCoding, GzipDecodesToTheInput) {
  const Bytes text = sampleText(), packed = encodeContent(ContentCoding::gzip, text);
  Bytes unpacked(text.size());
  libdeflate_decompressor* decompressor = libdeflate_alloc_decompressor();
  const auto result =
      libdeflate_gzip_decompress(decompressor, packed.data(), packed.size(), unpacked.data(), unpacked.size(), nullptr);
  libdeflate_free_decompressor(decompressor);
  ASSERT_EQ(result, LIBDEFLATE_SUCCESS);
  EXPECT_EQ(unpacked, text);
  EXPECT_LT(packed.size(), text.size() / 10);
}

TEST(CodingCache, EachContentIsEncodedOnce) {
  CodingCache cache(100);
  int calls = 0;
  const auto encode = [&] { return ++calls, Bytes(10, 1); };
  EXPECT_EQ(cache.get("a", encode)->size(), 10u);
  EXPECT_EQ(cache.get("a", encode)->size(), 10u);
  EXPECT_EQ(calls, 1);
}

TEST(CodingCache, TheEntryUnusedForLongestIsEvictedFirst) {
  CodingCache cache(100);
  int calls = 0;
  const auto encode = [&] { return ++calls, Bytes(40, 1); };
  cache.get("a", encode);
  cache.get("b", encode);
  cache.get("a", encode);
  cache.get("c", encode); // evicts b
  EXPECT_EQ(cache.heldBytes(), 80u);
  EXPECT_EQ(calls, 3);
  cache.get("a", encode);
  EXPECT_EQ(calls, 3);
  cache.get("b", encode);
  EXPECT_EQ(calls, 4);
}

TEST(CodingCache, ContentLargerThanTheLimitIsReturnedButNotKept) {
  CodingCache cache(100);
  EXPECT_EQ(cache.get("a", [] { return Bytes(101, 1); })->size(), 101u);
  EXPECT_EQ(cache.heldBytes(), 0u);
}

} // namespace
} // namespace imgeo
