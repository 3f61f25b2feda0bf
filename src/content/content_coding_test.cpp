#include "content/content_coding.h"

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

TEST(ContentCoding, TheSmallestEffortIsSmallerThanTheFastOneAndDecodesToTheSame) {
  // Indices of a strip of quads, the typed array that gains most.
  Bytes indices;
  for (std::uint32_t quad = 0; quad < 5000; ++quad)
    for (const std::uint32_t offset : {0u, 1u, 300u, 300u, 1u, 301u}) {
      const std::uint32_t index = quad + offset;
      indices.push_back(static_cast<std::uint8_t>(index & 0xff));
      indices.push_back(static_cast<std::uint8_t>(index >> 8));
    }
  for (const ContentCoding coding : {ContentCoding::brotli, ContentCoding::gzip})
    EXPECT_LE(encodeContent(coding, indices, CodingEffort::smallest).size(), encodeContent(coding, indices).size());
  const Bytes packed = encodeContent(ContentCoding::brotli, indices, CodingEffort::smallest);
  Bytes unpacked(indices.size());
  std::size_t size = unpacked.size();
  ASSERT_EQ(BrotliDecoderDecompress(packed.size(), packed.data(), &size, unpacked.data()),
            BROTLI_DECODER_RESULT_SUCCESS);
  EXPECT_EQ(unpacked, indices);
}

} // namespace
} // namespace imgeo
