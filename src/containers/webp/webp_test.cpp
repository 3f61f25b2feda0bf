#include "containers/webp/webp.h"

#include "base/error.h"
#include "base/error_testing.h"
#include "base/file.h"
#include "containers/image_file.h"
#include "containers/testing.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <libdeflate.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using testing::Random;

/// An image of random bytes whose rows repeat, so that it has matches, colour caches and literals; with a quarter of
/// its texels of alpha 0 where it has alpha.
Image randomImage(Random& random, std::uint32_t channels) {
  Image image{1 + random.below(70), 1 + random.below(70), channels, {}};
  image.pixels.resize(std::size_t{image.width} * image.height * channels);
  const std::uint32_t range = 1 + random.below(256);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = random.oneIn(3) && i > 40 ? image.pixels[i - 40] : static_cast<std::uint8_t>(random.below(range));
  for (std::size_t i = 3; channels == 4 && i < image.pixels.size(); i += 4)
    if (random.oneIn(4))
      image.pixels[i] = 0;
  return image;
}

/// The image as RGBA, as readers of WebP return it.
Image asRgba(const Image& image) {
  Image rgba{image.width, image.height, 4, {}};
  for (std::size_t n = 0; n < std::size_t{image.width} * image.height; ++n) {
    const std::uint8_t* pixel = &image.pixels[n * image.channels];
    if (!image.palette.empty())
      pixel = &image.palette[std::size_t{3} * *pixel];
    const bool isGray = image.channels == 1 && image.palette.empty();
    rgba.pixels.insert(rgba.pixels.end(), {pixel[0], pixel[isGray ? 0 : 1], pixel[isGray ? 0 : 2],
                                           image.channels == 4 ? pixel[3] : std::uint8_t{255}});
  }
  return rgba;
}

TEST(Webp, KeepsEveryByteAtEveryEffortAlsoUnderAlphaOfZero) {
  Random random(1);
  for (const std::uint32_t channels : {1u, 3u, 4u})
    for (int effort = 0; effort <= 9; ++effort)
      for (int n = 0; n < 2; ++n) {
        const Image image = randomImage(random, channels);
        const Bytes file = encodeWebp(image, effort);
        EXPECT_EQ(decodeWebp(file, "image"), asRgba(image)) << channels << " channels, effort " << effort;
        EXPECT_EQ(encodeWebp(image, effort), file);
        EXPECT_EQ(decodeImageFile(file, "image"), asRgba(image));
      }
}

TEST(Webp, ExpandsPalettes) {
  Random random(2);
  Image image = randomImage(random, 1);
  for (int entry = 0; entry < 256; ++entry)
    for (int channel = 0; channel < 3; ++channel)
      image.palette.push_back(static_cast<std::uint8_t>(random.bits()));
  EXPECT_EQ(decodeWebp(encodeWebp(image, 3), "image"), asRgba(image));
}

ErrorKind refusalOf(const Bytes& file) {
  try {
    (void)decodeWebp(file, "image");
  } catch (const Error& error) {
    EXPECT_EQ(error.location(), "image");
    EXPECT_FALSE(error.message().empty());
    return error.kind();
  }
  ADD_FAILURE() << "is read";
  return ErrorKind::usage;
}

TEST(Webp, IsRefusedWhereItEndsEarlyOrGoesOn) {
  Random random(3);
  const Bytes file = encodeWebp(randomImage(random, 3), 2);
  for (std::size_t size = 12; size < file.size(); ++size)
    EXPECT_EQ(refusalOf(Bytes(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size))), ErrorKind::truncated);
  Bytes longer = file;
  longer.insert(longer.end(), {0, 0});
  EXPECT_EQ(refusalOf(longer), ErrorKind::malformed);
  Bytes shorter = file; // the container is whole, its data are not
  shorter.resize(shorter.size() / 4 * 2);
  const std::uint32_t chunk = static_cast<std::uint32_t>(shorter.size()) - 20;
  for (std::uint32_t byte = 0; byte < 4; ++byte) {
    shorter[4 + byte] = static_cast<std::uint8_t>((chunk + 12) >> (8 * byte));
    shorter[16 + byte] = static_cast<std::uint8_t>(chunk >> (8 * byte));
  }
  EXPECT_EQ(refusalOf(shorter), ErrorKind::malformed);
}

TEST(Webp, IsRefusedInOtherFormatsAndBeyondTheLargestEdge) {
  Random random(4);
  const Bytes file = encodeWebp(randomImage(random, 4), 2);
  const auto with = [&](std::size_t offset, std::string_view name) {
    Bytes changed = file;
    std::ranges::copy(name, changed.begin() + static_cast<std::ptrdiff_t>(offset));
    return changed;
  };
  EXPECT_EQ(refusalOf(with(12, "VP8 ")), ErrorKind::unsupported);
  EXPECT_EQ(refusalOf(with(12, "VP8X")), ErrorKind::unsupported);
  EXPECT_EQ(refusalOf(with(8, "AVI ")), ErrorKind::malformed);
  EXPECT_EQ(refusalOf(with(20, "0")), ErrorKind::malformed);
  Bytes large = file;
  large[22] |= 0x3f; // the upper bits of the width
  EXPECT_EQ(refusalOf(large), ErrorKind::limit);
}

using Json = nlohmann::ordered_json;

Bytes changed(Bytes file, std::size_t offset, std::initializer_list<std::uint8_t> bytes) {
  std::ranges::copy(bytes, file.begin() + static_cast<std::ptrdiff_t>(offset));
  return file;
}

/// Writes vectors/webp: images of every kind that the writer makes, and files that readers refuse.
void writeVectors(const std::filesystem::path& folder) {
  Random random(5);
  Json verdicts;
  const auto add = [&](const std::string& name, const Bytes& file, const Json& verdict) {
    writeFile(folder / name, file);
    verdicts[name] = verdict;
  };
  Image palette = randomImage(random, 1);
  for (int entry = 0; entry < 256; ++entry)
    palette.palette.insert(palette.palette.end(),
                           {std::uint8_t(entry), std::uint8_t(7 * entry), std::uint8_t(255 - entry)});
  const Image rgba = randomImage(random, 4);
  for (const auto& [name, image] : {std::pair{"gray.webp", randomImage(random, 1)}, std::pair{"palette.webp", palette},
                                    std::pair{"rgb.webp", randomImage(random, 3)}, std::pair{"rgba.webp", rgba}}) {
    const Bytes pixels = asRgba(image).pixels;
    add(name, encodeWebp(image, 6),
        {{"width", image.width},
         {"height", image.height},
         {"crc32", fmt::format("{:08x}", libdeflate_crc32(0, pixels.data(), pixels.size()))}});
  }
  const Bytes file = encodeWebp(rgba, 6);
  const auto refuse = [&](const char* name, const Bytes& bytes) {
    add(name, bytes, {{"error", testing::nameOf(refusalOf(bytes))}});
  };
  refuse("cut.webp", Bytes(file.begin(), file.end() - 9));
  refuse("extended.webp", changed(file, 12, {'V', 'P', '8', 'X'}));
  refuse("lossy.webp", changed(file, 12, {'V', 'P', '8', ' '}));
  refuse("signature.webp", changed(file, 20, {0x30}));
  refuse("size.webp", changed(file, 4, {1}));
  refuse("version.webp", changed(file, 24, {static_cast<std::uint8_t>(file[24] | 0x20)}));
  refuse("wide.webp", changed(file, 22, {static_cast<std::uint8_t>(file[22] | 0x3f)}));
  writeFile(folder / "verdicts.json", asBytes(verdicts.dump(2) + "\n"));
}

/// The runtime's reader has the same verdicts on these files (web/src/decode/webp.test.ts), and a browser the same
/// pixels (tests/browser/webp.test.ts). IMGEO_REWRITE_GOLDEN=1 writes them again.
TEST(WebpVectors, HaveTheirPixelsOrErrors) {
  const std::filesystem::path folder = IMGEO_VECTORS "/webp";
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
    writeVectors(folder);
  const Json verdicts = Json::parse(asText(readFile(folder / "verdicts.json")));
  EXPECT_EQ(verdicts.size(), 11u);
  for (const auto& [name, verdict] : verdicts.items()) {
    SCOPED_TRACE(name);
    const Bytes file = readFile(folder / name);
    if (verdict.contains("error")) {
      EXPECT_EQ(verdict["error"], testing::nameOf(refusalOf(file)));
      continue;
    }
    const Image image = decodeWebp(file, name);
    EXPECT_EQ(image.width, verdict["width"]);
    EXPECT_EQ(image.height, verdict["height"]);
    EXPECT_EQ(verdict["crc32"], fmt::format("{:08x}", libdeflate_crc32(0, image.pixels.data(), image.pixels.size())));
  }
}

} // namespace
} // namespace imgeo
