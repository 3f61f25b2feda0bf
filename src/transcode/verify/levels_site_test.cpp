// Converts meshes to levels of detail, reads the sites back, and damages them.

#include "base/error.h"
#include "containers/levels/level_patches.h"
#include "scene/testing.h"
#include "transcode/sample/sample_file.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <fstream>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

ConvertOptions leveled(std::uint32_t groupTriangles) {
  ConvertOptions options;
  options.pictures = false;
  options.levels = LevelChoice::always;
  options.groupTriangles = groupTriangles;
  return options;
}

/// A site of a torus with colours on three levels.
struct LevelsSite {
  TemporaryDirectory directory;
  std::filesystem::path input = directory / "input.ply", site = directory / "site";
  ConvertReport report;

  LevelsSite() {
    Mesh mesh = testing::torus(60, 40);
    testing::Random random(1);
    for (Vec3f& position : mesh.positions)
      position += random.point() * 0.004f;
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      mesh.colors.push_back(random.color());
    testing::writeMesh(input, mesh);
    report = convert(input, site, leveled(400));
  }

  /// The files of the levels, in the order of filesOfLevels().
  std::vector<std::filesystem::path> files() const {
    const SiteDocument document = openDocument(site);
    std::vector<std::filesystem::path> paths;
    for (const auto& [url, role] : filesOfLevels(*document.scene.geometries.at(0).levels))
      paths.push_back(site / url);
    return paths;
  }
};

TEST(LevelsSite, HoldsTheMeshAndVerifies) {
  const LevelsSite site;
  const VerifyReport verified = verify(site.site, site.input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.site.triangles, 4800u);
  EXPECT_EQ(site.report.elements.triangles, 4800u);
  EXPECT_TRUE(site.report.warnings.empty()) << ::testing::PrintToString(site.report.warnings);

  const SiteInfo info = inspect(site.site);
  EXPECT_EQ(info.elements.triangles, 4800u);
  ASSERT_EQ(info.geometries.size(), 1u);
  const std::vector<LevelInfo>& levels = info.geometries[0].levels;
  ASSERT_GE(levels.size(), 3u);
  EXPECT_EQ(levels[0].triangles, 4800u);
  EXPECT_EQ(levels[0].error, 0);
  EXPECT_EQ(levels.back().groups, 1u);
  for (std::size_t level = 1; level < levels.size(); ++level) {
    EXPECT_LT(static_cast<double>(levels[level].triangles), 0.4 * static_cast<double>(levels[level - 1].triangles));
    EXPECT_GT(levels[level].error, levels[level - 1].error);
  }
  std::size_t listed = 0;
  for (const SiteFile& file : info.files)
    listed += file.role == "levels" || file.role == "base" || file.role == "patch";
  EXPECT_EQ(listed, site.files().size());
}

TEST(LevelsSite, NamesItsIndexAndRootAndNoPatches) {
  const LevelsSite site;
  const SiteDocument document = openDocument(site.site);
  EXPECT_EQ(document.text.find("<GeometryPatch"), document.text.npos);
  EXPECT_NE(document.text.find("/levels.png\""), document.text.npos);
  EXPECT_NE(document.text.find("/0/0.png\""), document.text.npos);
  EXPECT_EQ(document.scene.geometries.at(0).base->url, groupUrl(document.scene.geometries.at(0).levels->url, 0));
}

TEST(LevelsSite, HasTheSameBytesEveryTime) {
  const LevelsSite a, b;
  EXPECT_EQ(testing::contentsOf(a.site / "geometry"), testing::contentsOf(b.site / "geometry"));
}

TEST(LevelsSite, ExportsEveryLevel) {
  const LevelsSite site;
  const SiteInfo info = inspect(site.site);
  const std::size_t count = info.geometries.at(0).levels.size();
  for (std::uint32_t level = 0; level < count; ++level) {
    const ExportReport report = exportSite(site.site, site.directory / "out.ply", {}, level);
    EXPECT_EQ(report.elements.triangles, info.geometries[0].levels[level].triangles);
  }
  EXPECT_THROW(exportSite(site.site, site.directory / "out.ply", {}, static_cast<std::uint32_t>(count)), Error);
}

TEST(LevelsSite, BecomesASiteWithoutLevelsOfTheSameMesh) {
  const LevelsSite site;
  ConvertOptions options;
  options.pictures = false;
  convert(site.site / "scene.x3d", site.directory / "plain", options);
  const VerifyReport verified = verify(site.directory / "plain", site.site / "scene.x3d");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(readMeshes(openDocument(site.directory / "plain")).meshes.at(0).elementCount(), 4800u);
}

TEST(LevelsSite, IsReplacedByAnother) {
  const LevelsSite site;
  const std::size_t before = testing::contentsOf(site.site).size();
  convert(site.input, site.site, leveled(4000)); // without `force`: all files are known as those of a site
  EXPECT_LT(testing::contentsOf(site.site).size(), before);
}

TEST(LevelsSite, WithDamagedFilesIsRefusedOrDiffers) {
  const LevelsSite site;
  const std::vector<std::filesystem::path> files = site.files();
  for (const std::filesystem::path& file : {files.front(), files[1], files.back()}) {
    const Bytes bytes = readFile(file);
    Bytes cut = bytes;
    cut.resize(cut.size() / 2);
    writeFile(file, cut);
    const auto equals = [&] {
      try {
        return verify(site.site, site.input).equal;
      } catch (const Error& error) {
        EXPECT_FALSE(error.message().empty());
        return false;
      }
    };
    EXPECT_FALSE(equals()) << file;
    std::filesystem::remove(file);
    EXPECT_FALSE(equals()) << file;
    if (file == files.front()) {
      EXPECT_THROW(inspect(site.site), Error);
    }
    writeFile(file, bytes);
    EXPECT_TRUE(equals());
  }
}

TEST(LevelsSite, WithSwappedGroupsDiffers) {
  const LevelsSite site;
  const std::vector<std::filesystem::path> files = site.files();
  const Bytes last = readFile(files.back()), before = readFile(files[files.size() - 2]);
  writeFile(files.back(), before);
  writeFile(files[files.size() - 2], last);
  EXPECT_FALSE(verify(site.site, site.input).equal);
}

TEST(LevelsSite, WithAnIndexThatStatesSmallerErrorsIsFound) {
  const LevelsSite site;
  const std::filesystem::path file = site.files().front();
  LevelIndex index = readLevelIndex(file, [](const std::string& path) { return readFile(path); });
  for (LevelGroup& group : index.groups)
    if (group.errorCode != rootErrorCode)
      group.errorCode = group.level; // still nested
  writeFile(file, writeLevelIndex(index).at(0));
  const VerifyReport verified = verify(site.site, site.input);
  const bool isFound = std::ranges::any_of(verified.findings, [](const std::string& finding) {
    return finding.find("farther from their coarse form") != finding.npos;
  });
  EXPECT_TRUE(isFound) << ::testing::PrintToString(verified.findings);
}

TEST(LevelsSite, OfAReliefIsClosedOnEveryLevel) {
  for (const bool shuffled : {false, true}) {
    const TemporaryDirectory directory;
    const ExportReport sample = writeSampleRelief(5000, shuffled, directory / "relief.ply");
    convert(directory / "relief.ply", directory / "site", leveled(600));
    const VerifyReport verified = verify(directory / "site", directory / "relief.ply");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    EXPECT_EQ(verified.site.triangles, sample.elements.triangles);
  }
}

TEST(LevelsSite, HasNoLevelsWhereTheyAreNotAskedForOrCannotBe) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(20, 20));
  testing::writeMesh(directory / "points.ply", testing::pointCloud(200, 1));
  const auto levelsOf = [&](const std::string& input, const ConvertOptions& options) {
    convert(directory / input, directory / "site", options);
    return inspect(directory / "site").geometries.at(0).levels.size();
  };
  ConvertOptions options = leveled(300);
  EXPECT_GT(levelsOf("input.ply", options), 1u);
  EXPECT_EQ(levelsOf("points.ply", options), 0u);
  options.levels = LevelChoice::automatic;
  EXPECT_EQ(levelsOf("input.ply", options), 0u) << "a small mesh";
  options.levels = LevelChoice::always;
  options.encoding = Encoding::classic;
  EXPECT_THROW(convert(directory / "input.ply", directory / "site", options), Error);
}

} // namespace
} // namespace imgeo
