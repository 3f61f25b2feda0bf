// Compares sites with their inputs out of core, and expects what comparison in memory finds.

#include "base/error.h"
#include "base/soak_testing.h"
#include "containers/levels/level_patches.h"
#include "containers/png/png.h"
#include "content/content_coding.h"
#include "import/ply/testing.h"
#include "import/stl/testing.h"
#include "prepare/boxes_testing.h"
#include "scene/testing.h"
#include "transcode/sample/sample_file.h"
#include "transcode/verify/large_comparison_testing.h"

#include <algorithm>
#include <csignal>
#include <sys/resource.h>

namespace imgeo {
namespace {

using testing::expectEqualInBothWays;
using testing::findingsFor;
using testing::smallGroups;
using testing::TemporaryDirectory;
using testing::verifyBoth;

/// A torus of 24,000 triangles with texture coordinates.
Mesh texturedTorus() {
  Mesh mesh = testing::torus(150, 80);
  mesh.normals.clear();
  testing::Random random(7);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f;
  return mesh;
}

Mesh torusWithoutTexture() {
  Mesh mesh = texturedTorus();
  mesh.texCoords.clear();
  return mesh;
}

SOAK_TEST(LargeComparison, GivesTheReportOfComparisonInMemoryOverSeveralRegions) {
  for (const bool shuffled : {false, true}) {
    const TemporaryDirectory directory;
    writeSampleRelief(300000, shuffled, directory / "relief.ply");
    ConvertOptions options = smallGroups();
    options.groupTriangles = 8192;
    expectEqualInBothWays(directory, directory / "relief.ply", options);
  }
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForTextAndGzippedSources) {
  const TemporaryDirectory directory;
  writeFile(directory / "text.ply", testing::plyBytes(torusWithoutTexture(), {.encoding = "ascii"}));
  expectEqualInBothWays(directory, directory / "text.ply");
  writeFile(directory / "text.ply.gz", encodeContent(ContentCoding::gzip, readFile(directory / "text.ply")));
  expectEqualInBothWays(directory, directory / "text.ply.gz");
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForNormalsWithCreases) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "torus.ply", texturedTorus());
  ConvertOptions options = smallGroups();
  options.creaseDegrees = 15;
  expectEqualInBothWays(directory, directory / "torus.ply", options);
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForCreasesThatAreGuessed) {
  const TemporaryDirectory directory;
  writeFile(directory / "boxes.stl", testing::binaryStl(testing::boxes(1500)));
  expectEqualInBothWays(directory, directory / "boxes.stl");
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForStl) {
  const TemporaryDirectory directory;
  writeFile(directory / "torus.stl", testing::binaryStl(torusWithoutTexture()));
  expectEqualInBothWays(directory, directory / "torus.stl");
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForObj) {
  const Mesh mesh = torusWithoutTexture();
  std::string text;
  for (const Vec3f& position : mesh.positions)
    text += fmt::format("v {} {} {} 0.1 0.2 {}\n", position.x, position.y, position.z, position.x > 0 ? 0 : 1);
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    text += fmt::format("{}{}", corner % 3 == 0 ? "\nf " : " ", mesh.wedgePositions[mesh.corners[corner]] + 1);
  const TemporaryDirectory directory;
  writeFile(directory / "torus.obj", asBytes(text));
  expectEqualInBothWays(directory, directory / "torus.obj");
}

TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForColoursNormalsAndFewBits) {
  Mesh mesh = torusWithoutTexture();
  testing::Random random(1);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    mesh.colors.push_back(random.color());
    mesh.normals.push_back(random.direction());
  }
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "torus.ply", mesh);
  for (const std::uint32_t bits : {9u, 16u}) { // at 9 bits triangles collapse and coincide
    ConvertOptions options = smallGroups();
    options.positionBits = bits;
    expectEqualInBothWays(directory, directory / "torus.ply", options);
  }
}

/// An OBJ file of the torus, whose image is beside it.
void writeMappedObj(const std::filesystem::path& folder, const Mesh& mesh) {
  std::string text = "mtllib torus.mtl\nusemtl paint\n";
  for (const Vec3f& position : mesh.positions)
    text += fmt::format("v {} {} {}\n", position.x, position.y, position.z);
  for (const Vec2f& texCoord : mesh.texCoords)
    text += fmt::format("vt {} {}\n", texCoord.x, texCoord.y);
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    const std::uint32_t wedge = mesh.corners[corner];
    text += fmt::format("{}{}/{}", corner % 3 == 0 ? "\nf " : " ", mesh.wedgePositions[wedge] + 1, wedge + 1);
  }
  writeFile(folder / "torus.obj", asBytes(text));
  writeFile(folder / "torus.mtl", asBytes("newmtl paint\nmap_Kd torus.png\n"));
  writeFile(folder / "torus.png", encodePng({1024, 1024, 3, Bytes(std::size_t{3} * 1024 * 1024, 99), {}}, 1));
}

SOAK_TEST(LargeComparison, GivesTheReportOfComparisonInMemoryForTextureCoordinates) {
  Mesh mesh = texturedTorus();
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "torus.ply", mesh);
  expectEqualInBothWays(directory, directory / "torus.ply");
  const std::filesystem::path obj = directory / "torus.obj";
  writeMappedObj(directory.path(), mesh);
  expectEqualInBothWays(directory, obj);
  mesh.texCoords[7000] = {0.25f, 0.75f};
  writeMappedObj(directory.path(), mesh);
  const VerifyReport report = verifyBoth(directory, directory / "site", obj);
  ASSERT_EQ(report.findings.size(), 1u) << ::testing::PrintToString(report.findings);
  EXPECT_NE(report.findings[0].find("Texture coordinates are off"), std::string::npos);
}

TEST(LargeComparison, ComparesWhatWasConvertedOutOfCore) {
  const TemporaryDirectory directory;
  writeSampleRelief(100000, true, directory / "relief.ply");
  ConvertOptions options = smallGroups();
  options.regionTriangles = 16384;
  options.workFolder = directory / "convert-work";
  expectEqualInBothWays(directory, directory / "relief.ply", options);
}

TEST(LargeComparison, FindsOneTriangleThatIsOtherwiseMissingOrDoubled) {
  const TemporaryDirectory directory;
  const Mesh mesh = torusWithoutTexture();
  testing::writeMesh(directory / "input.ply", mesh);
  convert(directory / "input.ply", directory / "site", smallGroups());
  const auto has = [](const std::string& findings, const char* sentence) {
    return findings.find(sentence) != findings.npos;
  };
  const char *missing = "1 triangles of the input are missing from the site.",
             *extra = "1 triangles of the site are not in the input.";

  Mesh turned = mesh;
  std::swap(turned.corners[30000], turned.corners[30001]);
  const std::string ofTurned = findingsFor(directory, turned);
  EXPECT_TRUE(has(ofTurned, missing) && has(ofTurned, extra)) << ofTurned;
  Mesh without = mesh;
  without.corners.erase(without.corners.begin() + 30000, without.corners.begin() + 30003);
  const std::string ofWithout = findingsFor(directory, without);
  EXPECT_TRUE(has(ofWithout, extra) && !has(ofWithout, missing)) << ofWithout;
  Mesh doubled = mesh;
  for (std::size_t i = 30000; i < 30003; ++i)
    doubled.corners.push_back(doubled.corners[i]);
  const std::string ofDoubled = findingsFor(directory, doubled);
  EXPECT_TRUE(has(ofDoubled, missing) && !has(ofDoubled, extra)) << ofDoubled;
}

TEST(LargeComparison, FindsOtherColours) {
  Mesh mesh = torusWithoutTexture();
  mesh.colors.assign(mesh.wedgeCount(), Rgba{0.2f, 0.4f, 0.6f, 1});
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", mesh);
  convert(directory / "input.ply", directory / "site", smallGroups());
  mesh.colors[5000] = {1, 0, 0, 1};
  testing::writeMesh(directory / "other.ply", mesh);
  const VerifyReport report = verifyBoth(directory, directory / "site", directory / "other.ply");
  ASSERT_EQ(report.findings.size(), 1u) << ::testing::PrintToString(report.findings);
  EXPECT_NE(report.findings[0].find("have other colours"), std::string::npos);
  mesh.colors.clear();
  testing::writeMesh(directory / "other.ply", mesh);
  EXPECT_FALSE(verifyBoth(directory, directory / "site", directory / "other.ply").equal);
}

TEST(LargeComparison, FindsDamagedFilesOfTheSite) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", torusWithoutTexture());
  convert(directory / "input.ply", directory / "site", smallGroups());
  const LevelsDescription levels = *openDocument(directory / "site").scene.geometries.at(0).levels;
  const auto last = static_cast<std::uint32_t>(levels.index.groups.size() - 1);
  const std::filesystem::path file = directory / "site" / groupUrl(levels.url, last),
                              before = directory / "site" / groupUrl(levels.url, last - 1);
  const Bytes bytes = readFile(file);
  writeFile(file, ByteSpan(bytes).first(bytes.size() / 2));
  EXPECT_FALSE(verifyBoth(directory, directory / "site", directory / "input.ply").equal);
  std::filesystem::remove(file);
  EXPECT_FALSE(verifyBoth(directory, directory / "site", directory / "input.ply").equal);
  writeFile(file, bytes);

  // A sphere that does not contain its group.
  const std::filesystem::path index = directory / "site" / levels.url;
  LevelIndex wrong = levels.index;
  wrong.groups[last].sphere.radius = 0;
  writeFile(index, writeLevelIndex(wrong).at(0));
  const VerifyReport report = verifyBoth(directory, directory / "site", directory / "input.ply");
  EXPECT_TRUE(std::ranges::any_of(report.findings, [](const std::string& finding) {
    return finding.find("reach out of the sphere") != finding.npos;
  })) << ::testing::PrintToString(report.findings);
}

TEST(LargeComparison, EndsWithAnErrorWhereAWorkFileCannotBeWritten) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "mesh.ply", torusWithoutTexture());
  convert(directory / "mesh.ply", directory / "site", smallGroups());
  const std::filesystem::path work = directory / "work";
  // The source's triangles have 40 bytes each, the site's 76, with their normals: 1 and 1.8 MB.
  for (const rlim_t bytes : {500'000u, 1'400'000u}) {
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit low{bytes, before.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &low);
    EXPECT_THROW(verify(directory / "site", directory / "mesh.ply", {.workFolder = work}), Error) << bytes;
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_DFL);
    EXPECT_FALSE(std::filesystem::exists(work));
  }
  EXPECT_TRUE(verify(directory / "site", directory / "mesh.ply", {.workFolder = work}).equal);
}

TEST(LargeComparison, IsRefusedWhereItIsNotPossibleAndLeavesNothing) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "mesh.ply", torusWithoutTexture());
  ConvertOptions plain;
  plain.pictures = false;
  convert(directory / "mesh.ply", directory / "plain", plain);
  const std::filesystem::path work = directory / "work";
  EXPECT_TRUE(verify(directory / "plain", directory / "mesh.ply", {.workFolder = work}).equal);
  convert(directory / "mesh.ply", directory / "site", smallGroups());
  EXPECT_THROW(verify(directory / "site", directory / "mesh.ply", {.memoryBytes = 1000}), Error);
  writeFile(directory / "mesh.obj", asBytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n"));
  EXPECT_THROW(verify(directory / "site", directory / "mesh.obj", {.workFolder = work}), Error);
  testing::writeMesh(directory / "points.ply", testing::pointCloud(20000, 1));
  EXPECT_FALSE(verify(directory / "site", directory / "points.ply", {.workFolder = work}).equal);
  EXPECT_TRUE(verify(directory / "plain", directory / "mesh.ply", {.memoryBytes = testing::minVerifyingMemory}).equal);
  EXPECT_FALSE(std::filesystem::exists(work));

  // The work folder of a conversion that may be resumed stays as it is; that of a comparison that was killed does not.
  std::filesystem::create_directory(work);
  writeFile(work / "job.txt", asBytes("imgeo 0.1.0\n"));
  EXPECT_THROW(verify(directory / "site", directory / "mesh.ply", {.workFolder = work}), Error);
  EXPECT_TRUE(std::filesystem::exists(work / "job.txt"));
  writeFile(work / "job.txt", asBytes("imgeo verify\n"));
  EXPECT_TRUE(verify(directory / "site", directory / "mesh.ply", {.workFolder = work}).equal);
  EXPECT_FALSE(std::filesystem::exists(work));
}

} // namespace
} // namespace imgeo
