// Converts point clouds out of core and compares them with the same in memory; ends conversions and resumes them.

#include "base/parallel.h"
#include "base/soak_testing.h"
#include "content/content_coding.h"
#include "import/e57/testing.h"
#include "import/ply/testing.h"
#include "scene/testing.h"
#include "transcode/sample/sample_file.h"
#include "transcode/verify/out_of_core_testing.h"

#include <cstring>
#include <fmt/format.h>
#include <set>

namespace imgeo {
namespace {

using testing::contentsOf;
using testing::expectSameAsInMemory;
using testing::outOfCore;
using testing::refusal;
using testing::TemporaryDirectory;
using testing::withRegions;

ConvertOptions keepingAll(ConvertOptions options) {
  options.keepAttributes.all = true;
  return options;
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemory) {
  for (const bool shuffled : {false, true}) { // in several pieces
    const TemporaryDirectory directory;
    writeSampleCloud(shuffled ? 60000 : 30000, shuffled, directory / "cloud.ply");
    expectSameAsInMemory(directory, directory / "cloud.ply", keepingAll);
  }
}

/// Points of which some are at the positions of others, and some equal in all, with colours and normals.
Mesh repeatingCloud(std::uint32_t count) {
  testing::Random random(3);
  Mesh mesh = testing::pointCloud(count, 4);
  mesh.colors.clear(), mesh.normals.clear(), mesh.texCoords.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t other = random.below(i + 1);
    const bool repeats = random.oneIn(20);
    if (repeats)
      mesh.positions[i] = mesh.positions[other];
    const bool isEqual = repeats && random.oneIn(2);
    mesh.colors.push_back(isEqual && other < i ? mesh.colors[other] : Rgba(asRgba8(random.color())));
    mesh.normals.push_back(isEqual && other < i ? mesh.normals[other] : random.direction());
  }
  return mesh;
}

void convertRepeatedPoints(const char* encoding) {
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.ply",
            testing::plyBytes(repeatingCloud(30000), {.encoding = encoding, .real = "double"}));
  expectSameAsInMemory(directory, directory / "cloud.ply");
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForRepeatedPoints) {
  convertRepeatedPoints("binary_big_endian");
}

SOAK_TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForRepeatedPointsInOtherEncodings) {
  convertRepeatedPoints("binary_little_endian");
  convertRepeatedPoints("ascii");
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForGzippedSources) {
  const TemporaryDirectory directory;
  const Bytes file = testing::plyBytes(repeatingCloud(30000), {});
  writeFile(directory / "cloud.ply.gz", encodeContent(ContentCoding::gzip, file));
  expectSameAsInMemory(directory, directory / "cloud.ply.gz");
}

template <typename T> void put(Bytes& bytes, std::size_t offset, T value) {
  std::memcpy(&bytes[offset], &value, sizeof value);
}

/// A LAS file of format 3: with colours, which are dark in the first half of the points, intensities, classes and times
/// of GPS; some points are withheld, among them those of a whole piece.
Bytes lasCloud(std::uint32_t count) {
  constexpr std::uint16_t headerBytes = 227, recordBytes = 34;
  testing::Random random(8);
  Bytes file(headerBytes + std::size_t{recordBytes} * count);
  std::memcpy(file.data(), "LASF", 4);
  file[24] = 1, file[25] = 2;
  put(file, 94, headerBytes), put(file, 96, std::uint32_t{headerBytes});
  file[104] = 3, put(file, 105, recordBytes), put(file, 107, count);
  for (std::size_t axis = 0; axis < 3; ++axis)
    put(file, 131 + 8 * axis, 0.001), put(file, 155 + 8 * axis, axis == 1 ? 5'800'000.0 : 400'000.0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = headerBytes + std::size_t{recordBytes} * i;
    const Vec3f point = random.direction() * (1 + 0.01f * random.point().x);
    for (std::size_t axis = 0; axis < 3; ++axis)
      put(file, at + 4 * axis, static_cast<std::int32_t>(point[static_cast<int>(axis)] * 9000));
    put(file, at + 12, static_cast<std::uint16_t>(random.below(60000)));
    file[at + 15] = static_cast<std::uint8_t>(random.below(20) | (i < 20000 || random.oneIn(30) ? 0x80 : 0));
    put(file, at + 20, 1e9 + i);
    for (std::size_t channel = 0; channel < 3; ++channel)
      put(file, at + 28 + 2 * channel, static_cast<std::uint16_t>(random.below(i < count / 2 ? 255 : 65535)));
  }
  return file;
}

/// The tags of elements of a name in a site's document.
std::vector<std::string> elementsOf(const std::filesystem::path& site, const std::string& name) {
  const Bytes bytes = readFile(site / "scene.x3d");
  const std::string text(asText(bytes));
  std::vector<std::string> tags;
  for (std::size_t at = text.find("<" + name); at != std::string::npos; at = text.find("<" + name, at + 1))
    tags.push_back(text.substr(at, text.find('>', at) - at));
  EXPECT_FALSE(tags.empty()) << name;
  return tags;
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForTextureCoordinatesAndObj) {
  Mesh mesh = repeatingCloud(30000);
  std::string text;
  for (const Vec3f& position : mesh.positions) {
    mesh.texCoords.push_back({position.x, position.y});
    text += fmt::format("v {} {} {} 0.2 {} 1\n", position.x, position.y, position.z, mesh.texCoords.size() % 2);
  }
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.ply", testing::plyBytes(mesh, {}));
  expectSameAsInMemory(directory, directory / "cloud.ply");
  const TemporaryDirectory other;
  writeFile(other / "cloud.obj", asBytes(text));
  expectSameAsInMemory(other, other / "cloud.obj");
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForLas) {
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.las", lasCloud(60000));
  expectSameAsInMemory(directory, directory / "cloud.las", keepingAll);
  for (const char* element : {"ImageGeometry", "MetadataDouble"})
    EXPECT_EQ(elementsOf(directory / "site", element), elementsOf(directory / "memory", element));
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForE57) {
  const Mesh mesh = repeatingCloud(40000);
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i) {
    const Vec3f& at = mesh.positions[i];
    const Rgba8 color = asRgba8(mesh.colors[i]);
    points.push_back({4e5 + at.x, at.y, at.z, double(i % 4096), double(color.r), double(color.g), double(color.b)});
  }
  testing::TestFile file =
      testing::fileOf({testing::float64("cartesianX"), testing::float64("cartesianY"), testing::float64("cartesianZ"),
                       testing::integer("intensity", 0, 4095), testing::integer("colorRed", 0, 255),
                       testing::integer("colorGreen", 0, 255), testing::integer("colorBlue", 0, 255)},
                      points);
  file.packets = 50;
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.e57", file.file());
  expectSameAsInMemory(directory, directory / "cloud.e57", keepingAll);
  for (const char* element : {"ImageGeometry", "MetadataDouble"})
    EXPECT_EQ(elementsOf(directory / "site", element), elementsOf(directory / "memory", element));
  EXPECT_TRUE(verify(directory / "site", directory / "cloud.e57", {.workFolder = directory / "work"}).equal);
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForPts) {
  const Mesh mesh = repeatingCloud(30000);
  std::string text = "30000\r\n";
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i) {
    const Vec3f& at = mesh.positions[i];
    const Rgba8 color = asRgba8(mesh.colors[i]);
    text += fmt::format("{:.4f} {:.4f} {:.4f} {} {} {} {}\r\n", at.x + 1000, at.y, at.z, i % 4096, color.r, color.g,
                        color.b);
  }
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.pts", asBytes(text));
  expectSameAsInMemory(directory, directory / "cloud.pts", keepingAll);
}

TEST(CloudOutOfCore, HasTheFilesOfConversionInMemoryForPointsOfUnevenDensity) {
  testing::Random random(6);
  Mesh mesh = testing::pointCloud(40000, 1);
  mesh.colors.clear(), mesh.normals.clear(), mesh.texCoords.clear();
  for (Vec3f& position : mesh.positions) { // most of them near the origin, many of these at a few positions
    position = random.point();
    position = position * (0.001f + position.x * position.x * position.x * position.x);
    if (random.oneIn(3))
      position = Vec3f(0.25f * static_cast<float>(random.below(3)), 0, 0);
  }
  const TemporaryDirectory directory;
  writeFile(directory / "cloud.ply", testing::plyBytes(mesh, {}));
  expectSameAsInMemory(directory, directory / "cloud.ply");
}

TEST(CloudOutOfCore, HasTheSameFilesForAnyMemoryThreadsAndPieces) {
  const TemporaryDirectory directory;
  writeSampleCloud(50000, true, directory / "cloud.ply");
  convert(directory / "cloud.ply", directory / "site", outOfCore(directory));
  const auto expected = contentsOf(directory / "site");
  EXPECT_GT(expected.size(), 100u);
  for (const std::size_t threads : {1u, 3u}) {
    limitThreads(threads);
    ConvertOptions options = outOfCore(directory);
    options.force = true;
    options.memoryBytes = threads == 1 ? 80'000'000 : 1'000'000'000;
    convert(directory / "cloud.ply", directory / "site", options);
    limitThreads(0);
    EXPECT_EQ(contentsOf(directory / "site"), expected);
  }
}

SOAK_TEST(CloudOutOfCore, GoesOnWhereItWasEndedInAnyPass) {
  const TemporaryDirectory directory;
  writeSampleCloud(24000, false, directory / "cloud.ply");
  const std::set<std::string> steps = testing::expectGoesOnInAnyPass(directory, directory / "cloud.ply", "region-0-0");
  EXPECT_GE(steps.size(), 6u) << ::testing::PrintToString(steps);
}

TEST(CloudOutOfCore, RefusesWhatItCannotDo) {
  const TemporaryDirectory directory;
  const auto expectRefused = [&](const ConvertOptions& options, const std::string& words) {
    const std::string sentence = refusal(directory / "cloud.ply", directory / "site", options);
    EXPECT_NE(sentence.find(words), std::string::npos) << "'" << sentence << "' without '" << words << "'";
    EXPECT_FALSE(std::filesystem::exists(directory / "site"));
  };
  writeSampleCloud(300000, false, directory / "cloud.ply");
  ConvertOptions options = outOfCore(directory);
  options.groupTriangles = 8192; // regions of one group
  options.memoryBytes = 74'000'000;
  expectRefused(options, "the levels above regions of 4096 points");
  options = outOfCore(directory);
  options.keepAttributes.names = {"height"};
  expectRefused(options, "the input has no attribute \"height\"");
}

} // namespace
} // namespace imgeo
