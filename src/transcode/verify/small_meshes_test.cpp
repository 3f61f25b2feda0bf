// Converts and compares files of many small meshes that memory does not hold together.

#include "base/soak_testing.h"
#include "transcode/out_of_core/memory_needs.h"
#include "transcode/out_of_core/mesh_files.h"
#include "transcode/out_of_core/out_of_core.h"
#include "transcode/verify/large_comparison_testing.h"
#include "transcode/verify/out_of_core_testing.h"
#include "transcode/verify/several_meshes_testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using testing::contentsOf;
using testing::outOfCore;
using testing::TemporaryDirectory;
using testing::torus;
using testing::withRegions;

/// Memory of which what is known of so many meshes leaves hardly more than the minimum.
ConvertOptions withLittleMemory(const TemporaryDirectory& directory, std::uint64_t meshes) {
  ConvertOptions options = outOfCore(directory);
  options.memoryBytes = minimumMemory(options.regionTriangles) + structureMemory(meshes) + 1;
  return options;
}

/// Expects that a source that memory does not hold becomes the site of conversion in memory, with all its files.
void expectSameSite(const TemporaryDirectory& directory, const fs::path& input, std::uint64_t meshes) {
  ConvertOptions inMemory = withRegions(), large = withLittleMemory(directory, meshes);
  inMemory.pictures = large.pictures = true;
  const ConvertReport expected = convert(input, directory / "memory", inMemory);
  std::set<std::string> steps;
  const ConvertReport report =
      convert(input, directory / "site", large, [&](double, const std::string& step) { steps.insert(step); });
  EXPECT_TRUE(steps.contains("reading small meshes")) << ::testing::PrintToString(steps);
  EXPECT_EQ(contentsOf(directory / "site"), contentsOf(directory / "memory"));
  EXPECT_FALSE(fs::exists(directory / "work"));
  EXPECT_EQ(report.elements, expected.elements);
  EXPECT_EQ(report.vertices, expected.vertices);
  EXPECT_EQ(report.warnings, expected.warnings);
  EXPECT_EQ(report.instances.shapes, expected.instances.shapes);
  EXPECT_EQ(report.normalsComputed, expected.normalsComputed);
  EXPECT_EQ(report.edges.guessedSharp, expected.edges.guessedSharp);
  EXPECT_EQ(report.edges.guessedSmooth, expected.edges.guessedSmooth);
  EXPECT_EQ(report.edges.flat, expected.edges.flat);
  EXPECT_EQ(report.axes.upReason, expected.axes.upReason);
  const VerifyReport verified = testing::verifyBoth(directory, directory / "site", input);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
}

TEST(SmallMeshes, BecomeTheSameSiteWhereMemoryDoesNotHoldThemTogether) {
  const TemporaryDirectory directory;
  const fs::path input = directory / "building.glb";
  writeFile(input, testing::manySmallMeshes(700));
  expectSameSite(directory, input, 700);
}

TEST(SmallMeshes, ShareGeometryNodesAndInstancesAsInMemory) {
  const TemporaryDirectory directory;
  const fs::path input = directory / "building.glb";
  writeFile(input, testing::manySmallMeshes(2200));
  expectSameSite(directory, input, 2200);
  EXPECT_NE(testing::documentOf(directory / "site").find("USE="), std::string::npos);
}

SOAK_TEST(SmallMeshes, BecomeTheSameSiteForObjectsOfObjWhoseUpAxisIsGuessed) {
  const TemporaryDirectory directory;
  testing::writeManyObjects(directory / "house.obj", 110);
  expectSameSite(directory, directory / "house.obj", 110);
}

TEST(SmallMeshes, BecomeTheSameFilesBesideALargeOne) {
  const TemporaryDirectory directory;
  const fs::path input = directory / "several.glb";
  writeFile(input, testing::largeMeshAndSmallOnes(20));
  convert(input, directory / "memory", withRegions());
  convert(input, directory / "site", withLittleMemory(directory, 21));
  EXPECT_EQ(contentsOf(directory / "site" / "geometry"), contentsOf(directory / "memory" / "geometry"));
  EXPECT_TRUE(verify(directory / "site", input).equal);
}

/// Ends a conversion.
struct EndedInBatch {};

TEST(SmallMeshes, AreNotReadAgainWhereARunIsResumed) {
  const TemporaryDirectory directory;
  const fs::path input = directory / "building.glb";
  writeFile(input, testing::manySmallMeshes(700));
  convert(input, directory / "memory", withRegions());
  ConvertOptions options = withLittleMemory(directory, 700);
  std::set<fs::path> batches;
  const auto endInBatch = [&](double, const std::string& step) {
    if (step != "reading small meshes" || !fs::exists(directory / "work" / "small"))
      return;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory / "work" / "small"))
      batches.insert(entry.path());
    if (batches.size() == 3)
      throw EndedInBatch();
  };
  EXPECT_THROW(convert(input, directory / "site", options, endInBatch), EndedInBatch);
  EXPECT_FALSE(fs::exists(directory / "site"));
  ASSERT_EQ(batches.size(), 3u);
  const auto written = fs::last_write_time(*batches.begin());
  bool isKept = false;
  options.resume = true;
  convert(input, directory / "site", options, [&](double, const std::string& step) {
    if (step == "preparing")
      isKept = fs::last_write_time(*batches.begin()) == written;
  });
  EXPECT_TRUE(isKept);
  EXPECT_EQ(contentsOf(directory / "site" / "geometry"), contentsOf(directory / "memory" / "geometry"));
}

TEST(SmallMeshes, AreRefusedWhereMemoryDoesNotHoldOneOfThem) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "mesh.ply", torus(300, 150)); // without levels
  ConvertOptions options = withLittleMemory(directory, 1);
  options.levels = LevelChoice::automatic;
  EXPECT_NE(testing::refusal(directory / "mesh.ply", directory / "site", options).find("a mesh of 90000 triangles"),
            std::string::npos);
}

TEST(SmallMeshes, AreRefusedWhereMemoryDoesNotHoldWhatIsKnownOfThem) {
  const TemporaryDirectory directory;
  writeFile(directory / "building.glb", testing::manySmallMeshes(2200));
  EXPECT_NE(testing::refusal(directory / "building.glb", directory / "site", withLittleMemory(directory, 0))
                .find("what is known of 2200 meshes"),
            std::string::npos);
}

TEST(SmallMeshes, AreReadFromAWorkFileAsTheyWere) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", testing::severalMeshes());
  const auto source = ChunkedSource::open(directory / "several.glb", directory.path());
  const Bytes bytes = readBatch(*source, {1, 3}, {}, [](Scene&) {
    PreparationReport report;
    report.edges = {2, 1, 5};
    report.colorError = 0.25;
    return report;
  });
  writeFile(directory / "meshes", bytes);
  MeshFiles files;
  files.add(directory / "meshes");
  const Imported whole = source->readScene({1, 3}, {});
  EXPECT_FALSE(files.has(0));
  EXPECT_EQ(files.colorError(), 0.25);
  EXPECT_EQ(files.edges().guessedSharp, 2u);
  EXPECT_EQ(files.edges().guessedSmooth, 1u);
  EXPECT_EQ(files.edges().flat, 5u);
  for (const std::size_t number : {1, 3}) {
    const Mesh &expected = whole.scene.meshes[number], mesh = files.read(number);
    EXPECT_EQ(mesh.name, expected.name);
    EXPECT_EQ(mesh.positions, expected.positions);
    EXPECT_EQ(mesh.corners, expected.corners);
    EXPECT_EQ(mesh.normals, expected.normals);
    EXPECT_EQ(files.elementCount(number), expected.elementCount());
    EXPECT_EQ(files.box(number).max, boxOf(expected).max);
  }
  writeFile(directory / "cut", ByteSpan(bytes).first(bytes.size() / 2));
  EXPECT_THROW(files.add(directory / "cut"), Error);
  EXPECT_THROW(files.add(directory / "meshes"), Error); // whose meshes are there already
}

TEST(SmallMeshes, AreRefusedInAWorkFileWhereTheyAreNotWhatItSays) {
  const Mesh mesh = torus(5, 4);
  MeshFileWriter writer;
  writer.add(7, mesh);
  Bytes bytes = writer.finish({});
  EXPECT_EQ(MeshFile(bytes, "work").read(MeshFile(bytes, "work").entries().at(0)).corners, mesh.corners);
  bytes[8 + mesh.name.size() + 1 + 8 + 3] ^= 0x10; // the first coordinate
  const MeshFile damaged(bytes, "work");
  EXPECT_THROW(damaged.read(damaged.entries().at(0)), Error);
}

} // namespace
} // namespace imgeo
