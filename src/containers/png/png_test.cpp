#include "containers/png/png.h"

#include "base/error.h"
#include "containers/png/filters.h"

#include <gtest/gtest.h>
#include <random>

namespace imgeo {
namespace {

/// Noise over a smooth ramp: every filter has rows where it wins.
Image randomImage(std::mt19937& random, std::uint32_t channels) {
  const auto upTo = [&](std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(1, count)(random);
  };
  Image image{upTo(40), upTo(40), channels, {}};
  const std::uint32_t noise = upTo(255);
  for (std::uint32_t y = 0; y < image.height; ++y)
    for (std::uint32_t x = 0; x < image.width * channels; ++x)
      image.pixels.push_back(static_cast<std::uint8_t>(3 * x + 5 * y + random() % noise));
  return image;
}

TEST(Png, ComesBackExactlyAtEveryEffort) {
  std::mt19937 random(1);
  for (const std::uint32_t channels : {1u, 3u, 4u})
    for (int effort = 0; effort <= 9; ++effort)
      for (int round = 0; round < 5; ++round) {
        const Image image = randomImage(random, channels);
        EXPECT_EQ(decodePng(encodePng(image, effort), "x.png"), image)
            << channels << " channels, effort " << effort;
      }
}

TEST(Png, HoldsThreeChunksOnly) {
  std::mt19937 random(2);
  const Bytes png = encodePng(randomImage(random, 3), 5);
  std::string types;
  for (std::size_t at = 8; at < png.size(); at += 12 + loadBig<std::uint32_t>(&png[at]))
    types += std::string(asText(png).substr(at + 4, 4)) + " ";
  EXPECT_EQ(types, "IHDR IDAT IEND ");
}

TEST(Png, IsNotLargerWithMoreEffortThanWithNone) {
  std::mt19937 random(3);
  Image image{256, 64, 3, {}};
  for (std::uint32_t i = 0; i < 256 * 64 * 3; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(i / 7 + random() % 4));
  EXPECT_LE(encodePng(image, 9).size(), encodePng(image, 5).size());
  EXPECT_LT(encodePng(image, 5).size(), encodePng(image, 0).size());
}

TEST(Png, IsRefusedWhenAnyOfItsEndIsMissing) {
  std::mt19937 random(4);
  const Bytes png = encodePng(randomImage(random, 4), 5);
  for (std::size_t length = 0; length < png.size(); ++length)
    EXPECT_THROW(decodePng(ByteSpan(png).first(length), "x.png"), Error)
        << length << " of " << png.size() << " bytes";
}

TEST(Png, IsRefusedWhenAnyByteIsAltered) {
  std::mt19937 random(5);
  const Image image = randomImage(random, 3);
  const Bytes png = encodePng(image, 5);
  for (std::size_t at = 0; at < png.size(); ++at) {
    Bytes altered = png;
    altered[at] ^= static_cast<std::uint8_t>(1u << random() % 8);
    EXPECT_THROW(decodePng(altered, "x.png"), Error) << "byte " << at;
  }
}

TEST(Png, IsRefusedWhenBytesFollowIt) {
  Bytes png = encodePng({1, 1, 1, {7}}, 5);
  png.push_back(0);
  EXPECT_THROW(decodePng(png, "x.png"), Error);
}

/// A PNG header with right check sum and an IDAT of no use.
Bytes headerOnly(std::uint32_t width, std::uint32_t height, std::uint8_t depth, std::uint8_t colorType) {
  Bytes png = encodePng({1, 1, 1, {7}}, 0);
  Bytes size;
  appendBig(size, width);
  appendBig(size, height);
  std::copy(size.begin(), size.end(), png.begin() + 16);
  png[24] = depth;
  png[25] = colorType;
  std::uint32_t crc = 0xffffffff; // CRC-32 as PNG defines it, over type and data
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= png[i];
    for (int bit = 0; bit < 8; ++bit)
      crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  Bytes sum;
  appendBig(sum, ~crc);
  std::copy(sum.begin(), sum.end(), png.begin() + 29);
  return png;
}

ErrorKind kindOfDecoding(const Bytes& png) {
  try {
    decodePng(png, "x.png");
  } catch (const Error& error) {
    EXPECT_EQ(error.place(), "x.png");
    return error.kind();
  }
  ADD_FAILURE() << "was read";
  return ErrorKind::usage;
}

TEST(Png, OfOtherPixelsThanEightBitGrayRgbRgbaIsUnsupported) {
  EXPECT_EQ(decodePng(headerOnly(1, 1, 8, 0), "x.png").pixels, Bytes{7}); // the helper itself
  EXPECT_EQ(kindOfDecoding(headerOnly(1, 1, 16, 0)), ErrorKind::unsupported);
  EXPECT_EQ(kindOfDecoding(headerOnly(1, 1, 8, 4)), ErrorKind::unsupported);
  EXPECT_EQ(kindOfDecoding(headerOnly(1, 1, 8, 3)), ErrorKind::unsupported);
  EXPECT_EQ(kindOfDecoding(headerOnly(1, 1, 1, 0)), ErrorKind::unsupported);
}

TEST(Png, ThatPromisesMoreThanItsBytesCanHoldIsRefusedBeforeMemoryIsTaken) {
  EXPECT_EQ(kindOfDecoding(headerOnly(4096, 4096, 8, 6)), ErrorKind::truncated);
  EXPECT_EQ(kindOfDecoding(headerOnly(4097, 1, 8, 0)), ErrorKind::limit);
  EXPECT_EQ(kindOfDecoding(headerOnly(0x7fffffff, 0x7fffffff, 8, 0)), ErrorKind::limit);
}

TEST(Filters, ThatAdaptKeepTheSmallestDifferences) {
  const Image ramp{4, 2, 1, {10, 20, 30, 40, 10, 20, 30, 40}};
  const Bytes rows = filterRows(ramp, Filter::adaptive);
  EXPECT_EQ(rows, (Bytes{1, 10, 10, 10, 10, 2, 0, 0, 0, 0}));
}

} // namespace
} // namespace imgeo
