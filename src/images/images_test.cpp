#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/image_type.h"
#include "images/resize.h"
#include "images/testing.h"

#include "base/error.h"

#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

int maxDifference(const Raster& a, const Raster& b) {
  int maximum = a.width == b.width && a.height == b.height ? 0 : 256;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    maximum = std::max(maximum, std::abs(a.pixels[i] - b.pixels[i]));
  return maximum;
}

/// A white PNG of one bit a pixel, 16,384 columns and eight rows; `rows` is what its header states, with a checksum.
Bytes widePng(std::uint8_t rowsHigh, std::uint8_t rowsLow, std::uint32_t checksum) {
  Bytes png{137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 64, 0};
  png.insert(png.end(), {0, 0, rowsHigh, rowsLow, 1, 0, 0, 0, 0});
  appendBig(png, checksum);
  const Bytes rest{0,   0,   0,   53,  73,  68, 65, 84,  120, 218, 237, 214, 49,  13,  0,  0,   12,  195, 176, 242,
                   39,  221, 210, 152, 52,  27, 66, 174, 164, 0,   192, 59,  145, 0,   0,  12,  0,   0,   96,  0,
                   0,   0,   3,   0,   0,   24, 0,  0,   192, 0,   0,   0,   6,   0,   0,  184, 106, 221, 242, 195,
                   178, 58,  247, 82,  173, 0,  0,  0,   0,   73,  69,  78,  68,  174, 66, 96,  130};
  png.insert(png.end(), rest.begin(), rest.end());
  return png;
}

/// A gradient that a lossy encoder keeps.
Raster smoothRaster() {
  Raster raster{32, 16, {}};
  for (std::uint32_t y = 0; y < 16; ++y)
    for (std::uint32_t x = 0; x < 32; ++x)
      for (const std::uint32_t value : {4 * x, 8 * y, 128 + 2 * x, 255u})
        raster.pixels.push_back(static_cast<std::uint8_t>(value));
  return raster;
}

Raster rasterOf(std::uint32_t width, std::uint32_t height, Bytes pixels) {
  return {width, height, std::move(pixels)};
}

TEST(ImageType, IsRecognisedByTheFirstBytes) {
  EXPECT_EQ(imageType(asBytes("\x89PNG\r\n\x1a\n...")), ".png");
  EXPECT_EQ(imageType(asBytes("RIFF....WEBPVP8L")), ".webp");
  EXPECT_EQ(imageType(asBytes({"II*\0....", 8})), ".tif");
  EXPECT_EQ(imageType(tgaOf(testRaster(3, 2))), ".tga");
  for (const char* other :
       {"", "BM", "P7 ", "<svg xmlns='http://www.w3.org/2000/svg'></svg>", "just some words of a text"})
    EXPECT_EQ(imageType(asBytes(other)), "") << other;
}

TEST(DecodeRaster, ReadsTypesThatBrowsersDoNotShow) {
  const Raster transparent = testRaster(9, 5, true);
  EXPECT_EQ(decodeRaster(tgaOf(transparent), "a.tga"), transparent);
  const Raster gray = decodeRaster(asBytes("P2\n2 1\n255\n7 200\n"), "a.pnm");
  EXPECT_EQ(gray, rasterOf(2, 1, {7, 7, 7, 255, 200, 200, 200, 255}));
}

TEST(DecodeRaster, RestoresLosslessWebpExactlyAlsoWhereAlphaIsZero) {
  for (const bool isTransparent : {false, true}) {
    const Raster raster = testRaster(17, 11, isTransparent);
    EXPECT_EQ(decodeRaster(encodeLosslessWebp(raster), "a.webp"), raster);
  }
}

TEST(DecodeRaster, RefusesHugeImagesByTheirHeader) {
  Bytes bomb = tgaOf(testRaster(1, 1));
  bomb[2] = 10; // run-length encoded: a few bytes may stand for all of them
  const auto expectLimit = [&](std::uint8_t widthHigh, std::uint8_t heightHigh) {
    bomb[13] = widthHigh;
    bomb[15] = heightHigh;
    try {
      decodeRaster(bomb, "bomb.tga");
      ADD_FAILURE() << "decoded";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::limit);
      EXPECT_EQ(error.location(), "bomb.tga");
    }
  };
  expectLimit(255, 0);
  expectLimit(48, 48);
}

TEST(DecodeRaster, StatesTheSizeOfAnAtlasThatIsTooLarge) {
  const Raster raster = decodeRaster(widePng(0, 8, 0x29ebda3d), "edge.png");
  EXPECT_EQ(raster.width, 16384u);
  EXPECT_EQ(raster.pixels.back(), 255);
  try {
    decodeRaster(widePng(64, 0, 0x81b32d29), "atlas.png");
    ADD_FAILURE() << "decoded";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_EQ(error.message(), "is an image of 16384 x 16384 pixels; more than 16384 along an edge or 67108864 in all "
                               "are not decoded");
  }
}

TEST(DecodeRaster, RefusesEveryPrefixOfAFile) {
  const Bytes whole = encodeLosslessWebp(testRaster(9, 7, true));
  for (std::size_t size = 0; size < whole.size() - 1; ++size)
    EXPECT_THROW(decodeRaster({whole.data(), size}, "cut.webp"), Error) << size;
  const Bytes tga = tgaOf(testRaster(9, 7));
  for (std::size_t size = 0; size < tga.size(); ++size)
    EXPECT_THROW(decodeRaster({tga.data(), size}, "cut.tga"), Error) << size;
}

TEST(EncodeImage, LosesLittleOfSmoothImages) {
  const Raster raster = smoothRaster();
  const Bytes webp = encodeWebp(raster, 90);
  EXPECT_LE(maxDifference(decodeRaster(webp, "a.webp"), raster), 12);
  EXPECT_LT(encodeWebp(raster, 10).size(), webp.size());
  EXPECT_EQ(imageType(encodeAvif(raster, 60)), ".avif");
  EXPECT_LT(encodeAvif(testRaster(64, 64), 20).size(), encodeAvif(testRaster(64, 64), 90).size());
}

TEST(Downscaled, AveragesColorsAsLightAndNumbersAsNumbers) {
  const Raster checkers = rasterOf(2, 1, {0, 0, 0, 255, 255, 255, 255, 255});
  EXPECT_EQ(downscaled(checkers, {1, 1}, PixelContent::color), rasterOf(1, 1, {188, 188, 188, 255}));
  EXPECT_EQ(downscaled(checkers, {1, 1}, PixelContent::numbers), rasterOf(1, 1, {128, 128, 128, 255}));
}

TEST(Downscaled, IgnoresTheColorOfTransparentPixels) {
  const Raster raster = rasterOf(2, 1, {255, 0, 0, 0, 0, 0, 255, 255});
  EXPECT_EQ(downscaled(raster, {1, 1}, PixelContent::color), rasterOf(1, 1, {0, 0, 255, 128}));
}

TEST(Downscaled, KeepsDirectionsAtUnitLength) {
  const Raster raster = rasterOf(2, 1, {255, 128, 128, 255, 128, 128, 255, 255}); // along x, along z
  const Raster mean = downscaled(raster, {1, 1}, PixelContent::directions);
  EXPECT_NEAR(mean.pixels[0], 127.5 + 127.5 * std::sqrt(0.5), 1);
  EXPECT_NEAR(mean.pixels[1], 127.5, 1);
  EXPECT_NEAR(mean.pixels[2], 127.5 + 127.5 * std::sqrt(0.5), 1);
}

TEST(Downscaled, WeighsPixelsByTheirCoveredArea) {
  // Each of the two pixels covers one and a half of the three.
  const Raster raster = rasterOf(3, 1, {30, 0, 0, 255, 60, 0, 0, 255, 90, 0, 0, 255});
  EXPECT_EQ(downscaled(raster, {2, 1}, PixelContent::numbers), rasterOf(2, 1, {40, 0, 0, 255, 80, 0, 0, 255}));
}

TEST(SizeWithin, KeepsProportionsAndEnlargesNothing) {
  const auto fitted = [](std::uint32_t width, std::uint32_t height, std::uint32_t maxEdge) {
    const RasterSize size = sizeWithin({width, height}, maxEdge);
    return std::pair(size.width, size.height);
  };
  EXPECT_EQ(fitted(4000, 1000, 512), std::pair(512u, 128u));
  EXPECT_EQ(fitted(3, 4000, 64), std::pair(1u, 64u));
  EXPECT_EQ(fitted(100, 20, 512), std::pair(100u, 20u));
}

} // namespace
} // namespace imgeo::testing
