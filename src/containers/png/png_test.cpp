#include "containers/png/png.h"

#include "base/error.h"
#include "containers/png/filters.h"

#include <gtest/gtest.h>
#include <random>

namespace imgeo {
namespace {

/// Noise over a smooth ramp, so that each row filter is the best for some rows.
Image randomImage(std::mt19937& random, std::uint32_t channels) {
  const auto upTo = [&](std::uint32_t count) { return std::uniform_int_distribution<std::uint32_t>(1, count)(random); };
  Image image{upTo(40), upTo(40), channels, {}};
  const std::uint32_t noise = upTo(255);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width * channels; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>(3 * x + 5 * y + random() % noise));
  return image;
}

/// CRC-32 as PNG defines it, over type and data.
std::uint32_t crcOf(ByteSpan bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const std::uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit)
      crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

/// A PNG of one gray pixel whose header states these fields instead.
Bytes withHeader(std::uint32_t width, std::uint32_t height, std::uint8_t depth, std::uint8_t colorType) {
  Bytes png = encodePng({1, 1, 1, {7}}, 0);
  Bytes size, sum;
  appendBig(size, width);
  appendBig(size, height);
  std::copy(size.begin(), size.end(), png.begin() + 16);
  png[24] = depth;
  png[25] = colorType;
  appendBig(sum, crcOf(ByteSpan(png).subspan(12, 17)));
  std::copy(sum.begin(), sum.end(), png.begin() + 29);
  return png;
}

/// A PNG with one more chunk before its IDAT.
Bytes withChunk(Bytes png, std::string_view type, const Bytes& data) {
  Bytes chunk;
  appendBig(chunk, static_cast<std::uint32_t>(data.size()));
  chunk.insert(chunk.end(), type.begin(), type.end());
  chunk.insert(chunk.end(), data.begin(), data.end());
  appendBig(chunk, crcOf(ByteSpan(chunk).subspan(4)));
  const auto at = static_cast<std::ptrdiff_t>(asText(png).find("IDAT") - 4);
  png.insert(png.begin() + at, chunk.begin(), chunk.end());
  return png;
}

ErrorKind decodingErrorKind(const Bytes& png) {
  try {
    decodePng(png, "x.png");
  } catch (const Error& error) {
    EXPECT_EQ(error.location(), "x.png");
    return error.kind();
  }
  ADD_FAILURE() << "was read";
  return ErrorKind::usage;
}

TEST(Png, DecodesExactlyAtEveryEffort) {
  std::mt19937 random(1);
  for (const std::uint32_t channels : {1u, 3u, 4u})
    for (int effort = 0; effort <= 9; ++effort)
      for (int round = 0; round < 5; ++round) {
        const Image image = randomImage(random, channels);
        EXPECT_EQ(decodePng(encodePng(image, effort), "x.png"), image) << channels << " channels, effort " << effort;
      }
}

TEST(Png, WithAPaletteDecodesToRgb) {
  std::mt19937 random(6);
  for (const std::size_t entries : {1u, 2u, 77u, 256u}) {
    Image indices = randomImage(random, 1), rgb{indices.width, indices.height, 3, {}};
    for (std::size_t i = 0; i < 3 * entries; ++i)
      indices.palette.push_back(static_cast<std::uint8_t>(random()));
    for (std::uint8_t& pixel : indices.pixels) {
      pixel = static_cast<std::uint8_t>(pixel % entries);
      rgb.pixels.insert(rgb.pixels.end(), &indices.palette[3u * pixel], &indices.palette[3u * pixel] + 3);
    }
    EXPECT_EQ(decodePng(encodePng(indices, 5), "x.png"), rgb) << entries << " entries";
  }
}

TEST(Png, WithPixelsBeyondItsPaletteIsMalformed) {
  const Image image{2, 1, 1, {0, 3}, {1, 2, 3, 4, 5, 6, 7, 8, 9}};
  EXPECT_EQ(decodingErrorKind(encodePng(image, 5)), ErrorKind::malformed);
}

TEST(Png, WithATransparentPaletteIsUnsupported) {
  EXPECT_EQ(decodingErrorKind(withChunk(encodePng({1, 1, 1, {0}, {1, 2, 3}}, 5), "tRNS", {128})),
            ErrorKind::unsupported);
}

TEST(Png, WithATransparentGrayIsUnsupported) {
  EXPECT_EQ(decodingErrorKind(withChunk(encodePng({1, 1, 1, {7}}, 5), "tRNS", {0, 7})), ErrorKind::unsupported);
}

TEST(Png, IsReadDespiteTextChunks) {
  Bytes png = encodePng({1, 1, 1, {7}}, 5);
  for (int i = 0; i < 300; ++i)
    png = withChunk(png, "tEXt", {'T', 0, 'x'});
  EXPECT_EQ(decodePng(png, "x.png").pixels, Bytes{7});
}

TEST(Png, WithUnknownCriticalChunksOrSeparatedDataIsMalformed) {
  const Bytes png = encodePng({1, 1, 1, {7}}, 5);
  for (const char* type : {"ABCD", "IHDR"})
    EXPECT_EQ(decodingErrorKind(withChunk(png, type, {})), ErrorKind::malformed) << type;
  EXPECT_EQ(decodePng(withChunk(png, "IDAT", {}), "x.png").pixels, Bytes{7}); // adjacent IDAT chunks
  Bytes apart = withChunk(png, "IDAT", {}); // with a text between the first and the second
  const std::size_t second = asText(apart).find("IDAT", asText(apart).find("IDAT") + 4) - 4;
  const Bytes text = withChunk(png, "tEXt", {'T', 0, 'x'});
  const std::size_t begin = asText(text).find("tEXt") - 4;
  apart.insert(apart.begin() + static_cast<std::ptrdiff_t>(second), text.begin() + static_cast<std::ptrdiff_t>(begin),
               text.begin() + static_cast<std::ptrdiff_t>(begin + 15));
  EXPECT_EQ(decodingErrorKind(apart), ErrorKind::malformed);
}

TEST(Png, HasThreeChunks) {
  std::mt19937 random(2);
  const Bytes png = encodePng(randomImage(random, 3), 5);
  std::string types;
  for (std::size_t at = 8; at < png.size(); at += 12 + loadBig<std::uint32_t>(&png[at]))
    types += std::string(asText(png).substr(at + 4, 4)) + " ";
  EXPECT_EQ(types, "IHDR IDAT IEND ");
}

TEST(Png, IsSmallerWithEffortThanWithout) {
  std::mt19937 random(3);
  Image image{256, 64, 3, {}};
  for (std::uint32_t i = 0; i < 256 * 64 * 3; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(i / 7 + random() % 4));
  EXPECT_LE(encodePng(image, 9).size(), encodePng(image, 5).size());
  EXPECT_LT(encodePng(image, 5).size(), encodePng(image, 0).size());
}

TEST(Png, IsRefusedIfItIsCutAnywhere) {
  std::mt19937 random(4);
  const Bytes png = encodePng(randomImage(random, 4), 5);
  for (std::size_t length = 0; length < png.size(); ++length)
    EXPECT_THROW(decodePng(ByteSpan(png).first(length), "x.png"), Error) << length << " of " << png.size() << " bytes";
}

TEST(Png, IsRefusedIfAByteIsAltered) {
  std::mt19937 random(5);
  const Image image = randomImage(random, 3);
  const Bytes png = encodePng(image, 5);
  for (std::size_t at = 0; at < png.size(); ++at) {
    Bytes altered = png;
    altered[at] ^= static_cast<std::uint8_t>(1u << random() % 8);
    EXPECT_THROW(decodePng(altered, "x.png"), Error) << "byte " << at;
  }
}

TEST(Png, IsRefusedIfBytesFollowIt) {
  Bytes png = encodePng({1, 1, 1, {7}}, 5);
  png.push_back(0);
  EXPECT_THROW(decodePng(png, "x.png"), Error);
}

TEST(Png, WithPixelsOtherThanEightBitGrayRgbRgbaOrPaletteIsUnsupported) {
  EXPECT_EQ(decodePng(withHeader(1, 1, 8, 0), "x.png").pixels, Bytes{7}); // checks withHeader
  EXPECT_EQ(decodingErrorKind(withHeader(1, 1, 16, 0)), ErrorKind::unsupported);
  EXPECT_EQ(decodingErrorKind(withHeader(1, 1, 8, 4)), ErrorKind::unsupported);
  EXPECT_EQ(decodingErrorKind(withHeader(1, 1, 1, 0)), ErrorKind::unsupported);
}

TEST(Png, WithASizeBeyondItsBytesIsRefusedBeforeAllocation) {
  EXPECT_EQ(decodingErrorKind(withHeader(4096, 4096, 8, 6)), ErrorKind::truncated);
  EXPECT_EQ(decodingErrorKind(withHeader(4097, 1, 8, 0)), ErrorKind::limit);
  EXPECT_EQ(decodingErrorKind(withHeader(0x7fffffff, 0x7fffffff, 8, 0)), ErrorKind::limit);
}

TEST(AdaptiveFilters, KeepTheSmallestDifferences) {
  const Image ramp{4, 2, 1, {10, 20, 30, 40, 10, 20, 30, 40}};
  const Bytes rows = filterRows(ramp, RowFilter::adaptive);
  EXPECT_EQ(rows, (Bytes{1, 10, 10, 10, 10, 2, 0, 0, 0, 0}));
}

} // namespace
} // namespace imgeo
