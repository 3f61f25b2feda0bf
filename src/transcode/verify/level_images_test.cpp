// Converts meshes with textures to levels of detail whose groups have images of their own, and reads the sites back.

#include "containers/levels/level_patches.h"
#include "containers/png/png.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

constexpr std::uint32_t cells = 60, atlasEdge = 512;

ConvertOptions leveled() {
  ConvertOptions options;
  options.pictures = false;
  options.levels = LevelChoice::always;
  options.groupTriangles = 1024;
  return options;
}

/// Writes a relief in two charts, and its image. `scale`: of the texture coordinates.
std::filesystem::path writeRelief(const std::filesystem::path& directory, double scale = 1) {
  std::string text = "mtllib a.mtl\nusemtl a\n";
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x)
      text += fmt::format("v {} {} {}\nvt {} {}\nvt {} {}\n", x, y, 2 * std::sin(0.2 * x) * std::cos(0.3 * y),
                          scale * x / cells / 2, scale * y / cells, scale * (0.5 + x / 2.0 / cells), scale * y / cells);
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const auto corner = [&](std::uint32_t dx, std::uint32_t dy) {
        const std::uint32_t vertex = (y + dy) * (cells + 1) + x + dx;
        return fmt::format("{}/{}", vertex + 1, 2 * vertex + (y < cells / 2 ? 1 : 2));
      };
      text += fmt::format("f {} {} {} {}\n", corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
    }
  writeFile(directory / "a.obj", asBytes(text));
  writeFile(directory / "a.mtl", asBytes("newmtl a\nmap_Kd a.png\n"));
  Image image{atlasEdge, atlasEdge, 3, {}, {}};
  for (std::uint32_t y = 0; y < atlasEdge; ++y)
    for (std::uint32_t x = 0; x < atlasEdge; ++x)
      image.pixels.insert(image.pixels.end(), {static_cast<std::uint8_t>(x / 2), static_cast<std::uint8_t>(y / 2), 77});
  writeFile(directory / "a.png", encodePng(image, 1));
  return directory / "a.obj";
}

TEST(LevelImages, AreWrittenAndTheSiteEqualsItsInput) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeRelief(directory.path()), site = directory / "site";
  const ConvertReport report = convert(input, site, leveled());
  EXPECT_TRUE(report.warnings.empty()) << ::testing::PrintToString(report.warnings);
  const VerifyReport verified = verify(site, input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);

  const SiteDocument document = openDocument(site);
  const LevelsDescription& levels = *document.scene.geometries.at(0).levels;
  EXPECT_EQ(levels.chipSet, 1u);
  EXPECT_TRUE(levels.index.hasChips);
  EXPECT_GE(levels.index.levelCount(), 3u);
  std::uint64_t texels = 0;
  for (std::uint32_t number = 0; number < levels.index.groups.size(); ++number) {
    const LevelGroup& group = levels.index.groups[number];
    texels += std::uint64_t{group.chipColumns} * group.chipRows;
    EXPECT_EQ(readFile(site / chipUrl(levels.url, number)).size(), group.chipBytes);
  }
  EXPECT_LE(static_cast<double>(texels), 1.5 * atlasEdge * atlasEdge);

  // Readers see the texture coordinates of the source.
  const Mesh mesh = readMeshes(document).meshes.at(0);
  EXPECT_EQ(texCoordSetCount(mesh), 1u);
  EXPECT_TRUE(mesh.texCoordMappings.empty());

  std::size_t images = 0;
  for (const SiteFile& file : inspect(site).files)
    images += file.role == "chips";
  EXPECT_EQ(images, levels.index.groups.size());

  std::filesystem::remove(site / chipUrl(levels.url, 0));
  EXPECT_FALSE(verify(site, input).equal);
}

TEST(LevelImages, AreTheSameEveryTime) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeRelief(directory.path());
  convert(input, directory / "one", leveled());
  convert(input, directory / "two", leveled());
  EXPECT_EQ(testing::contentsOf(directory / "one" / "geometry"), testing::contentsOf(directory / "two" / "geometry"));
}

TEST(LevelImages, AreNotMadeOfTexturesThatRepeat) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeRelief(directory.path(), 3), site = directory / "site";
  convert(input, site, leveled());
  EXPECT_TRUE(verify(site, input).equal);
  EXPECT_EQ(openDocument(site).scene.geometries.at(0).levels->chipSet, 0u);
}

} // namespace
} // namespace imgeo
