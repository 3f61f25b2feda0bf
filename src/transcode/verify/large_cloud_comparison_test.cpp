// Compares sites of point clouds with their inputs out of core, and expects what comparison in memory finds.

#include "base/soak_testing.h"
#include "containers/levels/level_patches.h"
#include "content/content_coding.h"
#include "import/ply/testing.h"
#include "scene/testing.h"
#include "transcode/sample/sample_file.h"
#include "transcode/verify/large_comparison_testing.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo {
namespace {

using testing::expectEqualInBothWays;
using testing::findingsFor;
using testing::smallGroups;
using testing::TemporaryDirectory;
using testing::verifyBoth;

/// Points with colours and normals, of which some are at the positions of others, and some equal in all.
Mesh repeatingCloud() {
  constexpr std::uint32_t count = 40000;
  testing::Random random(3);
  Mesh mesh = testing::pointCloud(count, 4);
  mesh.colors.clear(), mesh.normals.clear(), mesh.texCoords.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t other = random.below(i + 1);
    const bool repeats = random.oneIn(20), isEqual = repeats && other < i && random.oneIn(2);
    if (repeats)
      mesh.positions[i] = mesh.positions[other];
    mesh.colors.push_back(isEqual ? mesh.colors[other] : Rgba(asRgba8(random.color())));
    mesh.normals.push_back(isEqual ? mesh.normals[other] : random.direction());
  }
  return mesh;
}

SOAK_TEST(LargeCloudComparison, GivesTheReportOfComparisonInMemoryOverSeveralRegions) {
  for (const bool shuffled : {false, true}) {
    const TemporaryDirectory directory;
    writeSampleCloud(300000, shuffled, directory / "cloud.ply");
    ConvertOptions options = smallGroups();
    options.groupTriangles = 8192;
    options.keepAttributes.all = true;
    expectEqualInBothWays(directory, directory / "cloud.ply", options);
  }
}

void compareRepeatedPoints(const char* encoding, std::uint32_t bits) {
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.ply.gz",
            encodeContent(ContentCoding::gzip, testing::plyBytes(repeatingCloud(), {.encoding = encoding})));
  ConvertOptions options = smallGroups();
  options.positionBits = bits;
  expectEqualInBothWays(directory, directory / "cloud.ply.gz", options);
}

constexpr std::uint32_t coincidingBits = 9; // at 9 bits many points coincide

TEST(LargeCloudComparison, GivesTheReportOfComparisonInMemoryForRepeatedPointsAndFewBits) {
  compareRepeatedPoints("binary_big_endian", coincidingBits);
}

SOAK_TEST(LargeCloudComparison, GivesTheReportOfComparisonInMemoryForRepeatedPointsInOtherEncodings) {
  compareRepeatedPoints("binary_big_endian", 16);
  compareRepeatedPoints("ascii", coincidingBits);
  compareRepeatedPoints("ascii", 16);
}

SOAK_TEST(LargeCloudComparison, GivesTheReportOfComparisonInMemoryForPtsAndObj) {
  const Mesh mesh = repeatingCloud();
  std::string pts = fmt::format("{}\n", mesh.wedgeCount()), obj;
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i) {
    const Vec3f& at = mesh.positions[i];
    const Rgba8 color = asRgba8(mesh.colors[i]);
    pts +=
        fmt::format("{:.4f} {:.4f} {:.4f} {} {} {} {}\n", at.x + 1000, at.y, at.z, i % 4096, color.r, color.g, color.b);
    obj += fmt::format("v {} {} {} 0.2 {} 1\n", at.x, at.y, at.z, i % 2);
  }
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.pts", asBytes(pts));
  ConvertOptions options = smallGroups();
  options.keepAttributes.all = true;
  expectEqualInBothWays(directory, directory / "cloud.pts", options);
  writeFile(directory / "cloud.obj", asBytes(obj));
  expectEqualInBothWays(directory, directory / "cloud.obj");
}

TEST(LargeCloudComparison, ComparesWhatWasConvertedOutOfCore) {
  const TemporaryDirectory directory;
  writeSampleCloud(60000, true, directory / "cloud.ply");
  ConvertOptions options = smallGroups();
  options.regionTriangles = 16384;
  options.workFolder = directory / "convert-work";
  expectEqualInBothWays(directory, directory / "cloud.ply", options);
}

TEST(LargeCloudComparison, FindsPointsThatAreMissingOrHaveOtherColours) {
  const TemporaryDirectory directory;
  const Mesh mesh = repeatingCloud();
  testing::writeMesh(directory / "input.ply", mesh);
  convert(directory / "input.ply", directory / "site", smallGroups());
  Mesh more = mesh;
  more.positions[100] = more.positions[30000]; // within the box
  EXPECT_NE(findingsFor(directory, more).find("1 points of the input are missing from the site."), std::string::npos);
  Mesh colored = mesh;
  for (Rgba& color : colored.colors)
    color.g = 1 - color.g;
  EXPECT_NE(findingsFor(directory, colored).find("points have other colours"), std::string::npos);
}

TEST(LargeCloudComparison, FindsDamagedFilesAndErrorsOfTheSite) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", repeatingCloud());
  convert(directory / "input.ply", directory / "site", smallGroups());
  const auto check = [&] { return verifyBoth(directory, directory / "site", directory / "input.ply"); };
  EXPECT_TRUE(check().equal);
  const LevelsDescription levels = *openDocument(directory / "site").scene.geometries.at(0).levels;
  const auto last = static_cast<std::uint32_t>(levels.index.groups.size() - 1);
  const std::filesystem::path file = directory / "site" / groupUrl(levels.url, last);
  const Bytes bytes = readFile(file);
  writeFile(file, ByteSpan(bytes).first(bytes.size() / 2));
  EXPECT_FALSE(check().equal);
  writeFile(file, bytes);

  // A group that states to be nearer to its coarse form than it is.
  LevelIndex wrong = levels.index;
  wrong.groups[last].errorCode = 1;
  writeFile(directory / "site" / levels.url, writeLevelIndex(wrong).at(0));
  const VerifyReport report = check();
  EXPECT_TRUE(std::ranges::any_of(report.findings, [](const std::string& finding) {
    return finding.find("farther from their coarse form") != finding.npos;
  })) << ::testing::PrintToString(report.findings);
}

} // namespace
} // namespace imgeo
