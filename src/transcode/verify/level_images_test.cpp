// Converts meshes with textures to levels of detail whose groups have images of their own, and reads the sites back.

#include "base/soak_testing.h"
#include "containers/levels/level_patches.h"
#include "containers/png/png.h"
#include "images/decode_image.h"
#include "scene/testing.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"
#include "transcode/verify/out_of_core_testing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <regex>
#include <thread>
#include <utility>

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

/// Writes a relief in two charts, and its image. `scale`: of the texture coordinates. `edge`: squares along an edge.
std::filesystem::path writeRelief(const std::filesystem::path& directory, double scale = 1,
                                  std::uint32_t edge = cells) {
  std::string text = "mtllib a.mtl\nusemtl a\n";
  for (std::uint32_t y = 0; y <= edge; ++y)
    for (std::uint32_t x = 0; x <= edge; ++x)
      text += fmt::format("v {} {} {}\nvt {} {}\nvt {} {}\n", x, y, 2 * std::sin(0.2 * x) * std::cos(0.3 * y),
                          scale * x / edge / 2, scale * y / edge, scale * (0.5 + x / 2.0 / edge), scale * y / edge);
  for (std::uint32_t y = 0; y < edge; ++y)
    for (std::uint32_t x = 0; x < edge; ++x) {
      const auto corner = [&](std::uint32_t dx, std::uint32_t dy) {
        const std::uint32_t vertex = (y + dy) * (edge + 1) + x + dx;
        return fmt::format("{}/{}", vertex + 1, 2 * vertex + (y < edge / 2 ? 1 : 2));
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

/// Expects that a source becomes the same files in memory and out of core, with the same warnings.
void expectSameOutOfCore(const TemporaryDirectory& directory, const std::filesystem::path& input) {
  const ConvertReport small = convert(input, directory / "memory", testing::withRegions());
  const ConvertReport large = convert(input, directory / "site", testing::outOfCore(directory));
  EXPECT_EQ(testing::contentsOf(directory / "site" / "geometry"),
            testing::contentsOf(directory / "memory" / "geometry"));
  EXPECT_EQ(large.warnings, small.warnings);
  EXPECT_EQ(large.resampledTextures, small.resampledTextures);
  EXPECT_EQ(large.texCoordError, small.texCoordError);
  EXPECT_FALSE(std::filesystem::exists(directory / "work"));
  for (const char* work : {"", "work"}) {
    const VerifyReport verified =
        verify(directory / "site", input, {.workFolder = work[0] == 0 ? std::filesystem::path() : directory / work});
    EXPECT_TRUE(verified.equal) << work << ::testing::PrintToString(verified.findings);
  }
}

SOAK_TEST(LevelImages, AreTheSameOutOfCore) { // in one piece, and in several
  for (const std::uint32_t edge : {60u, 160u}) {
    const TemporaryDirectory directory;
    expectSameOutOfCore(directory, writeRelief(directory.path(), 1, edge));
    EXPECT_TRUE(openDocument(directory / "site").scene.geometries.at(0).levels->index.hasChips);
  }
}

TEST(LevelImages, AreTheSameOutOfCoreForImagesWithinGlb) {
  const TemporaryDirectory directory;
  convert(writeRelief(directory.path()), directory / "first", leveled());
  exportSite(directory / "first", directory / "a.glb");
  expectSameOutOfCore(directory, directory / "a.glb");
  EXPECT_TRUE(openDocument(directory / "site").scene.geometries.at(0).levels->index.hasChips);
}

SOAK_TEST(LevelImages, AreTheSameWhereAConversionOutOfCoreGoesOn) {
  const TemporaryDirectory directory;
  const std::set<std::string> steps =
      testing::expectGoesOnInAnyPass(directory, writeRelief(directory.path()), "groups-100-0");
  EXPECT_GE(steps.size(), 6u) << ::testing::PrintToString(steps);
}

TEST(LevelImages, AreRefusedOutOfCoreWhereMemoryDoesNotHoldTheWholeImage) {
  const TemporaryDirectory directory;
  ConvertOptions options = testing::outOfCore(directory);
  options.memoryBytes = 76'000'000;
  const std::string sentence = testing::refusal(writeRelief(directory.path()), directory / "site", options);
  EXPECT_NE(sentence.find("bytes a pixel while it is decoded"), std::string::npos) << sentence;
}

TEST(LevelImages, AreNotMadeOfTexturesThatRepeatWhichAWarningSays) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeRelief(directory.path(), 3), site = directory / "site";
  const ConvertReport report = convert(input, site, leveled());
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"All levels of the mesh \"a\" draw the whole image a.png, not images "
                                     "of their groups: its texture coordinates leave 0 .. 1."});
  EXPECT_TRUE(verify(site, input).equal);
  EXPECT_EQ(openDocument(site).scene.geometries.at(0).levels->chipSet, 0u);
}

/// Writes a relief in square charts without gaps between them, of so many squares along each edge, and its image.
std::filesystem::path writeFragments(const std::filesystem::path& directory, std::uint32_t chartSquares = 1) {
  writeRelief(directory); // for its image
  std::string text = "mtllib a.mtl\nusemtl a\n", faces;
  for (std::uint32_t y = 0; y <= cells; ++y)
    for (std::uint32_t x = 0; x <= cells; ++x)
      text += fmt::format("v {} {} {}\n", x, y, 2 * std::sin(0.2 * x) * std::cos(0.3 * y));
  const std::uint32_t perEdge = cells / chartSquares;
  std::uint32_t coords = 0;
  for (std::uint32_t y = 0; y < cells; ++y)
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t chartX = x / chartSquares, chartY = y / chartSquares;
      const std::uint32_t column = (7 * chartX + chartY) % perEdge * chartSquares + x % chartSquares,
                          row = (11 * chartY + chartX) % perEdge * chartSquares + y % chartSquares;
      faces += "f";
      for (const auto& [dx, dy] : {std::pair(0u, 0u), {1u, 0u}, {1u, 1u}, {0u, 1u}}) {
        text += fmt::format("vt {} {}\n", double(column + dx) / cells, double(row + dy) / cells);
        faces += fmt::format(" {}/{}", (y + dy) * (cells + 1) + x + dx + 1, ++coords);
      }
      faces += "\n";
    }
  writeFile(directory / "fragments.obj", asBytes(text + faces));
  return directory / "fragments.obj";
}

/// Writes triangles in all directions, each a chart of its own, and their image: charts that no others can replace.
std::filesystem::path writeSplinters(const std::filesystem::path& directory) {
  writeRelief(directory); // for its image
  testing::Random random(3);
  std::string text = "mtllib a.mtl\nusemtl a\n", faces;
  std::uint32_t corners = 0;
  for (std::uint32_t square = 0; square < cells * cells; ++square) {
    const Vec3f center = random.point();
    faces += "f";
    for (const auto& [dx, dy] : {std::pair(0u, 0u), {1u, 0u}, {0u, 1u}}) {
      const Vec3f at = center + random.point() * 0.02f;
      text += fmt::format("v {} {} {}\nvt {} {}\n", at.x, at.y, at.z, double(square % cells + dx) / cells,
                          double(square / cells + dy) / cells);
      ++corners;
      faces += fmt::format(" {0}/{0}", corners);
    }
    faces += "\n";
  }
  writeFile(directory / "splinters.obj", asBytes(text + faces));
  return directory / "splinters.obj";
}

TEST(LevelImages, AreResampledWhereTheChartsOfTheSourceAreFragments) {
  for (const std::uint32_t chartSquares : {1u, 5u}) { // too small with their gutters alone, and with all levels
    const TemporaryDirectory directory;
    const std::filesystem::path input = writeFragments(directory.path(), chartSquares), site = directory / "site";
    const ConvertReport report = convert(input, site, leveled());
    EXPECT_TRUE(report.warnings.empty()) << ::testing::PrintToString(report.warnings);
    EXPECT_EQ(report.resampledTextures, 1u);
    const VerifyReport verified = verify(site, input);
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    const SiteDocument document = openDocument(site);
    const LevelsDescription& levels = *document.scene.geometries.at(0).levels;
    EXPECT_EQ(levels.chipSet, 1u);
    std::uint64_t texels = 0;
    for (const LevelGroup& group : levels.index.groups)
      texels += std::uint64_t{group.chipColumns} * group.chipRows;
    EXPECT_LE(static_cast<double>(texels), 1.5 * atlasEdge * atlasEdge) << chartSquares;
    EXPECT_GE(static_cast<double>(texels), 0.7 * atlasEdge * atlasEdge) << chartSquares;
    convert(input, directory / "again", leveled());
    EXPECT_EQ(testing::contentsOf(directory / "again" / "geometry"), testing::contentsOf(site / "geometry"));
  }
}

void expectSameWhereResampled(std::uint32_t chartSquares) {
  const TemporaryDirectory directory;
  expectSameOutOfCore(directory, writeFragments(directory.path(), chartSquares));
  EXPECT_TRUE(openDocument(directory / "site").scene.geometries.at(0).levels->index.hasChips);
}

TEST(LevelImages, AreTheSameOutOfCoreWhereTheyAreResampled) {
  expectSameWhereResampled(1);
}

SOAK_TEST(LevelImages, AreTheSameOutOfCoreWhereFurtherChartsAreResampled) {
  expectSameWhereResampled(5);
}

TEST(LevelImages, AreTheSameWhereRanksShareTheirResampling) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeFragments(directory.path());
  const ConvertReport small = convert(input, directory / "memory", testing::withRegions());
  std::vector<std::string> sentences(3);
  std::vector<std::thread> ranks;
  for (std::uint32_t rank = 0; rank < sentences.size(); ++rank)
    ranks.emplace_back([&, rank] {
      ConvertOptions options = testing::outOfCore(directory);
      options.ranks.rank = rank;
      options.ranks.count = static_cast<std::uint32_t>(sentences.size());
      sentences[rank] = testing::refusal(input, directory / "site", options);
    });
  for (std::thread& rank : ranks)
    rank.join();
  EXPECT_EQ(sentences, std::vector<std::string>(sentences.size()));
  EXPECT_EQ(small.resampledTextures, 1u);
  EXPECT_EQ(testing::contentsOf(directory / "site" / "geometry"),
            testing::contentsOf(directory / "memory" / "geometry"));
}

SOAK_TEST(LevelImages, AreTheSameWhereResamplingGoesOn) {
  for (const std::uint32_t chartSquares : {1u, 5u}) {
    const TemporaryDirectory directory;
    testing::expectGoesOnInAnyPass(directory, writeFragments(directory.path(), chartSquares),
                                   chartSquares == 1 ? "groups-100-0" : "groups-200-0");
  }
}

SOAK_TEST(LevelImages, AreNotMadeOfSplintersThatWouldTakeTooManyTexelsWhichAWarningSays) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeSplinters(directory.path()), site = directory / "site";
  const ConvertReport report = convert(input, site, leveled());
  EXPECT_EQ(report.resampledTextures, 0u);
  ASSERT_EQ(report.warnings.size(), 1u);
  std::smatch numbers;
  ASSERT_TRUE(
      std::regex_match(report.warnings[0], numbers,
                       std::regex("All levels of the mesh \"splinters\" draw the whole image a.png, not images of "
                                  "their groups: its charts are so small that these would have at least ([0-9]+) "
                                  "texels, more than 1.5 times the "
                                  "([0-9]+) of the whole image\\.")))
      << report.warnings[0];
  EXPECT_GT(std::stoull(numbers[1]), atlasEdge * atlasEdge * 3 / 2);
  EXPECT_EQ(std::stoull(numbers[2]), atlasEdge * atlasEdge);
  const VerifyReport verified = verify(site, input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(openDocument(site).scene.geometries.at(0).levels->chipSet, 0u);
  EXPECT_EQ(convert(input, directory / "again", leveled()).warnings, report.warnings);
}

constexpr std::uint32_t largeEdge = 1024;

/// Writes four reliefs side by side: two with textures of their own, one whose texture repeats, one without a texture.
/// The blue of each texture tells it from the others.
std::filesystem::path writeFour(const std::filesystem::path& directory) {
  std::string text = "mtllib four.mtl\n", materials;
  for (std::uint32_t part = 0; part < 4; ++part) {
    const std::string name(1, static_cast<char>('p' + part));
    text += fmt::format("usemtl {}\no {}\n", name, name);
    materials += fmt::format("newmtl {}\nKd 1 1 1\n{}", name, part < 3 ? fmt::format("map_Kd {}.png\n", name) : "");
    const double scale = part == 2 ? 3 : 0.8;
    for (std::uint32_t y = 0; y <= cells; ++y)
      for (std::uint32_t x = 0; x <= cells; ++x)
        text += fmt::format("v {} {} {}\nvt {} {}\n", x + part * (cells + 5), y,
                            2 * std::sin(0.2 * x + part) * std::cos(0.3 * y), scale * x / cells, scale * y / cells);
    const std::uint32_t first = part * (cells + 1) * (cells + 1) + 1;
    for (std::uint32_t y = 0; y < cells; ++y)
      for (std::uint32_t x = 0; x < cells; ++x) {
        const std::uint32_t a = first + y * (cells + 1) + x, c = a + cells + 1;
        text += fmt::format("f {0}/{0} {1}/{1} {2}/{2} {3}/{3}\n", a, a + 1, c + 1, c);
      }
    Image image{largeEdge, largeEdge, 3, {}, {}};
    for (std::uint32_t y = 0; y < largeEdge; ++y)
      for (std::uint32_t x = 0; x < largeEdge; ++x)
        image.pixels.insert(image.pixels.end(), {static_cast<std::uint8_t>(x / 4), static_cast<std::uint8_t>(y / 4),
                                                 static_cast<std::uint8_t>(50 * part)});
    writeFile(directory / (name + ".png"), encodePng(image, 1));
  }
  writeFile(directory / "four.obj", asBytes(text));
  writeFile(directory / "four.mtl", asBytes(materials));
  return directory / "four.obj";
}

/// Checks a site of four reliefs: the groups of the first two have images of their own texture.
void expectFour(const std::filesystem::path& site, const std::filesystem::path& input, const ConvertReport& report,
                const char* named) {
  ASSERT_EQ(report.warnings.size(), 1u) << ::testing::PrintToString(report.warnings);
  EXPECT_NE(report.warnings[0].find(named), std::string::npos) << report.warnings[0];
  EXPECT_NE(report.warnings[0].find("leave 0 .. 1"), std::string::npos) << report.warnings[0];
  const VerifyReport verified = verify(site, input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  const SiteDocument document = openDocument(site);
  std::size_t shapes = 0;
  for (const std::size_t node : shapeNodes(document.scene.graph)) {
    const GeometryDescription& geometry = document.scene.geometries.at(shapeOf(document.scene.graph, node).mesh);
    const long part = std::lround(geometry.box.min.x / (cells + 5));
    ASSERT_TRUE(geometry.levels) << part;
    ++shapes;
    EXPECT_EQ(geometry.levels->chipSet, part < 2 ? 1u : 0u) << part;
    EXPECT_EQ(geometry.levels->index.hasChips, part < 2) << part;
    std::uint64_t texels = 0;
    for (std::uint32_t number = 0; part < 2 && number < geometry.levels->index.groups.size(); ++number) {
      const Raster image = decodeRaster(readFile(site / chipUrl(geometry.levels->url, number)), "a chip");
      texels += std::uint64_t{image.width} * image.height;
      std::size_t wrong = 0;
      for (std::size_t at = 0; at < image.pixels.size(); at += 4)
        wrong += std::abs(image.pixels[at + 2] - 50 * part) > 1 && // or a gap between chips
                 (image.pixels[at] | image.pixels[at + 1] | image.pixels[at + 2]) != 0;
      EXPECT_EQ(wrong, 0u) << part << ' ' << number;
    }
    if (part < 2) {
      EXPECT_GT(static_cast<double>(texels), 0.8 * largeEdge * largeEdge) << part;
    }
  }
  EXPECT_EQ(shapes, 4u);
}

TEST(LevelImages, OfSeveralMaterialsAreEachOfItsOwnTexture) {
  const TemporaryDirectory directory;
  const std::filesystem::path obj = writeFour(directory.path()), fromObj = directory / "from-obj";
  expectFour(fromObj, obj, convert(obj, fromObj, leveled()), "the mesh \"r\" draw");
  const std::filesystem::path glb = directory / "four.glb", fromGlb = directory / "from-glb";
  exportSite(fromObj, glb);
  expectFour(fromGlb, glb, convert(glb, fromGlb, leveled()), "a mesh of material \"r_2\" draw");
}

SOAK_TEST(LevelImages, AreBuiltWithoutOutOfCoreWhereTheyAreOfNoUse) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeSplinters(directory.path());
  expectSameOutOfCore(directory, input);
  EXPECT_EQ(openDocument(directory / "site").scene.geometries.at(0).levels->chipSet, 0u);
  std::filesystem::remove_all(directory / "memory");
  std::filesystem::remove_all(directory / "site");
  testing::expectGoesOnInAnyPass(directory, input, "groups-0-0");
}

TEST(LevelImages, AreNotMadeOfMaterialsWithSeveralTexturesWhichAWarningSays) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = writeRelief(directory.path()), site = directory / "site";
  writeFile(directory / "a.mtl", asBytes("newmtl a\nmap_Kd a.png\nmap_Ke a.png\n"));
  const ConvertReport report = convert(input, site, leveled());
  EXPECT_EQ(report.warnings,
            std::vector<std::string>{"All levels of the mesh \"a\" draw whole images, not images of their "
                                     "groups: its material has 2 textures."});
  EXPECT_TRUE(verify(site, input).equal);
  EXPECT_EQ(openDocument(site).scene.geometries.at(0).levels->chipSet, 0u);
}

} // namespace
} // namespace imgeo
