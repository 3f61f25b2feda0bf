// Converts point clouds to levels of detail, reads the sites back, and damages them.

#include "base/error.h"
#include "base/parallel.h"
#include "containers/compact/compact.h"
#include "containers/levels/group_file.h"
#include "containers/levels/level_patches.h"
#include "scene/testing.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

ConvertOptions leveledCloud(std::uint32_t groupPoints) {
  ConvertOptions options;
  options.pictures = false;
  options.levels = LevelChoice::always;
  options.groupTriangles = groupPoints;
  options.keepAttributes.all = true;
  return options;
}

/// A site of a cloud with colours and a value on three levels or more.
struct PointLevelsSite {
  TemporaryDirectory directory;
  std::filesystem::path input = directory / "input.ply", site = directory / "site";
  ConvertReport report;

  PointLevelsSite() {
    Mesh mesh = testing::pointCloud(5000, 1);
    NamedAttribute intensity{"intensity", 1, {}};
    testing::Random random(2);
    for (Vec3f& position : mesh.positions)
      position.z = 0.1f * position.x * position.y;
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      intensity.values.push_back(static_cast<float>(random.below(65536)));
    mesh.namedAttributes = {intensity};
    testing::writeMesh(input, mesh);
    report = convert(input, site, leveledCloud(300));
  }

  LevelsDescription levels() const { return *openDocument(site).scene.geometries.at(0).levels; }

  std::filesystem::path fileOf(std::uint32_t group) const { return site / groupUrl(levels().url, group); }
};

TEST(PointLevelsSite, HoldsTheCloudAndVerifies) {
  const PointLevelsSite site;
  const VerifyReport verified = verify(site.site, site.input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.site.points, 5000u);
  EXPECT_EQ(site.report.elements.points, 5000u);
  EXPECT_TRUE(site.report.warnings.empty()) << ::testing::PrintToString(site.report.warnings);

  const SiteInfo info = inspect(site.site);
  EXPECT_EQ(info.elements.points, 5000u);
  const std::vector<LevelInfo>& levels = info.geometries.at(0).levels;
  ASSERT_GE(levels.size(), 3u);
  EXPECT_EQ(levels[0].points, 5000u);
  EXPECT_EQ(levels[0].error, 0);
  EXPECT_EQ(levels.back().groups, 1u);
  for (std::size_t level = 1; level < levels.size(); ++level) {
    EXPECT_LE(4 * levels[level].points, levels[level - 1].points);
    EXPECT_GE(5 * levels[level].points, levels[level - 1].points);
    EXPECT_GT(levels[level].error, levels[level - 1].error);
    EXPECT_EQ(levels[level].triangles, 0u);
  }
}

TEST(PointLevelsSite, NamesItsIndexAndElementsAndPreloadsItsRoot) {
  const PointLevelsSite site;
  const SiteDocument document = openDocument(site.site);
  EXPECT_EQ(document.text.find("<GeometryPatch"), document.text.npos);
  EXPECT_NE(document.text.find("primType=\"POINTS\""), document.text.npos);
  EXPECT_NE(document.text.find("/0/0.png\""), document.text.npos);
  EXPECT_FALSE(document.scene.geometries.at(0).base);
  EXPECT_EQ(document.scene.geometries.at(0).levels->topology, Topology::points);
}

TEST(PointLevelsSite, ExportsEveryLevelAsPointsOfTheCloud) {
  const PointLevelsSite site;
  const std::vector<LevelInfo> levels = inspect(site.site).geometries.at(0).levels;
  for (std::uint32_t level = 0; level < levels.size(); ++level) {
    const ExportReport report = exportSite(site.site, site.directory / "out.ply", {}, level);
    EXPECT_EQ(report.elements.points, levels[level].points);
  }
  EXPECT_THROW(exportSite(site.site, site.directory / "out.ply", {}, static_cast<std::uint32_t>(levels.size())), Error);
}

TEST(PointLevelsSite, HasTheSameBytesForAnyNumberOfThreads) {
  limitThreads(1);
  const PointLevelsSite a;
  limitThreads(0);
  const PointLevelsSite b;
  EXPECT_EQ(testing::contentsOf(a.site / "geometry"), testing::contentsOf(b.site / "geometry"));
}

TEST(PointLevelsSite, BecomesASiteWithoutLevelsOfTheSameCloud) {
  const PointLevelsSite site;
  ConvertOptions options;
  options.pictures = false;
  options.keepAttributes.all = true;
  convert(site.site / "scene.x3d", site.directory / "plain", options);
  const VerifyReport verified = verify(site.directory / "plain", site.site / "scene.x3d");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(readMeshes(openDocument(site.directory / "plain")).meshes.at(0).elementCount(), 5000u);
}

TEST(PointLevelsSite, HasLevelsOnlyWhereTheCloudIsLargerThanAGroup) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "points.ply", testing::pointCloud(1000, 1));
  const auto levelsOf = [&](const ConvertOptions& options) {
    convert(directory / "points.ply", directory / "site", options);
    return inspect(directory / "site").geometries.at(0).levels.size();
  };
  EXPECT_EQ(levelsOf(leveledCloud(1000)), 0u);
  EXPECT_GT(levelsOf(leveledCloud(999)), 1u);
  ConvertOptions automatic = leveledCloud(300);
  automatic.levels = LevelChoice::automatic;
  EXPECT_EQ(levelsOf(automatic), 0u);
}

/// Whether a finding of verify has some words.
bool hasFinding(const VerifyReport& verified, const std::string& words) {
  return std::ranges::any_of(verified.findings,
                             [&](const std::string& finding) { return finding.find(words) != finding.npos; });
}

TEST(PointLevelsSite, WithAnIndexThatStatesSmallerErrorsIsFound) {
  const PointLevelsSite site;
  const std::filesystem::path file = site.site / site.levels().url;
  LevelIndex index = readLevelIndex(file, [](const std::string& path) { return readFile(path); });
  for (LevelGroup& group : index.groups)
    if (group.errorCode != rootErrorCode)
      group.errorCode = group.level; // still nested
  writeFile(file, writeLevelIndex(index).at(0));
  const VerifyReport verified = verify(site.site, site.input);
  EXPECT_TRUE(hasFinding(verified, "farther from their coarse form")) << ::testing::PrintToString(verified.findings);
}

TEST(PointLevelsSite, WithAnIndexOfTrianglesIsRefused) {
  const PointLevelsSite site;
  const std::filesystem::path file = site.site / site.levels().url;
  LevelIndex index = readLevelIndex(file, [](const std::string& path) { return readFile(path); });
  index.hasPoints = false;
  for (LevelGroup& group : index.groups)
    group.triangles = 100;
  writeFile(file, writeLevelIndex(index).at(0));
  EXPECT_THROW(inspect(site.site), Error);
}

TEST(PointLevelsSite, WithAGroupOfOtherPointsThanItsParentsIsFound) {
  const PointLevelsSite site;
  // Two groups of level 0 with as many points and bytes each are not to be had, so the root's file is written anew.
  const SiteDocument document = openDocument(site.site);
  const GeometryDescription& geometry = document.scene.geometries.at(0);
  std::vector<compact::CompactPatch> segments = readPointGroup(*geometry.levels, 0, fetchFrom(document));
  for (compact::Attribute& attribute : segments.at(0).attributes)
    attribute.values.at(0).components[0] ^= 1;
  const Bytes changed = encodeCompact(segments, 5).file.bytes;
  writeFile(site.fileOf(0), changed);
  LevelIndex index = geometry.levels->index;
  index.groups[0].bytes = static_cast<std::uint32_t>(changed.size());
  writeFile(site.site / geometry.levels->url, writeLevelIndex(index).at(0));
  EXPECT_TRUE(hasFinding(verify(site.site, site.input), "lacks points that stand for it"));
}

TEST(PointLevelsSite, WithDamagedFilesIsRefusedOrDiffers) {
  const PointLevelsSite site;
  const auto last = static_cast<std::uint32_t>(site.levels().index.groups.size() - 1);
  for (const std::filesystem::path& file : {site.site / site.levels().url, site.fileOf(0), site.fileOf(last)}) {
    const Bytes bytes = readFile(file);
    Bytes cut = bytes;
    cut.resize(cut.size() / 2);
    const auto equals = [&] {
      try {
        return verify(site.site, site.input).equal;
      } catch (const Error& error) {
        EXPECT_FALSE(error.message().empty());
        return false;
      }
    };
    writeFile(file, cut);
    EXPECT_FALSE(equals()) << file;
    std::filesystem::remove(file);
    EXPECT_FALSE(equals()) << file;
    writeFile(file, bytes);
    EXPECT_TRUE(equals());
  }
}

} // namespace
} // namespace imgeo
