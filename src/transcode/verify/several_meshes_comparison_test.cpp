// Compares sites of several meshes and clouds with their inputs out of core, and expects what comparison in memory
// finds.

#include "base/error.h"
#include "containers/levels/level_patches.h"
#include "transcode/site/site_document.h"
#include "transcode/verify/choose_comparison.h"
#include "transcode/verify/large_comparison_testing.h"
#include "transcode/verify/several_meshes_testing.h"

#include <algorithm>

namespace imgeo {
namespace {

using testing::GltfText;
using testing::primitiveOf;
using testing::roughTorus;
using testing::smallGroups;
using testing::TemporaryDirectory;
using testing::verifyBoth;

ConvertOptions withAttributes() {
  ConvertOptions options = smallGroups();
  options.keepAttributes.all = true;
  return options;
}

/// Writes a GLB file of meshes, a node each with the name "mesh 0", "mesh 1" ...
void writeGlb(const std::filesystem::path& path, const std::vector<Mesh>& meshes) {
  GltfText gltf;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    gltf.show(gltf.addMesh({primitiveOf(gltf, meshes[i], false)}));
    gltf.json["nodes"].back()["name"] = fmt::format("mesh {}", i);
  }
  writeFile(path, gltf.glb());
}

TEST(ComparisonOfSeveralMeshes, GivesTheReportOfComparisonInMemoryForEachFormat) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", testing::severalMeshes());
  writeFile(directory / "scans.e57", testing::severalScans());
  writeFile(directory / "scans.pts", asBytes(testing::severalPtsScans()));
  testing::writeSeveralObjects(directory / "house.obj");
  testing::writeTexturedPly(directory / "torus.ply", "binary_little_endian");
  for (const char* file : {"several.glb", "scans.e57", "scans.pts", "house.obj", "torus.ply"}) {
    testing::expectEqualInBothWays(directory, directory / file, withAttributes());
    std::filesystem::remove_all(directory / "site");
  }
}

TEST(ComparisonOfSeveralMeshes, ComparesWhatWasConvertedOutOfCore) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", testing::severalMeshes());
  ConvertOptions options = smallGroups();
  options.regionTriangles = 8192;
  options.workFolder = directory / "convert-work";
  testing::expectEqualInBothWays(directory, directory / "several.glb", options);
}

TEST(ComparisonOfSeveralMeshes, NamesTheShapeWhoseMeshIsAnother) {
  const TemporaryDirectory directory;
  std::vector<Mesh> meshes{roughTorus(60, 40, {0, 0, 0}), roughTorus(70, 40, {4, 0, 0}), roughTorus(8, 8, {8, 0, 0})};
  writeGlb(directory / "input.glb", meshes);
  convert(directory / "input.glb", directory / "site", smallGroups());
  EXPECT_TRUE(verifyBoth(directory, directory / "site", directory / "input.glb").equal);
  for (const std::size_t mesh : {1, 2}) { // a large one and a small one
    std::vector<Mesh> others = meshes;
    std::swap(others[mesh].corners[30], others[mesh].corners[31]);
    writeGlb(directory / "other.glb", others);
    const std::string subject = fmt::format("Shape {} in \"mesh_{}\": ", mesh + 1, mesh);
    const std::vector<std::string> expected{subject + "1 triangles of the input are missing from the site.",
                                            subject + "1 triangles of the site are not in the input."};
    const std::vector<std::string> found = verifyBoth(directory, directory / "site", directory / "other.glb").findings;
    for (const std::string& sentence : expected)
      EXPECT_TRUE(std::ranges::find(found, sentence) != found.end()) << ::testing::PrintToString(found);
    EXPECT_TRUE(std::ranges::all_of(found, [&](const std::string& sentence) { return sentence.starts_with(subject); }))
        << ::testing::PrintToString(found);
  }
}

TEST(ComparisonOfSeveralMeshes, NamesTheGroupsThatAreDamagedAndComparesTheOtherMeshes) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "several.glb", site = directory / "site";
  writeFile(input, testing::severalMeshes());
  convert(input, site, smallGroups());
  std::vector<std::filesystem::path> groups;
  for (const GeometryDescription& geometry : openDocument(site).scene.geometries)
    if (geometry.levels)
      groups.push_back(groupUrl(geometry.levels->url, 4));
  ASSERT_EQ(groups.size(), 3u);
  for (const std::size_t damaged : {0, 2}) { // a mesh and the cloud
    const Bytes bytes = readFile(site / groups[damaged]);
    writeFile(site / groups[damaged], ByteSpan(bytes).first(bytes.size() / 2));
  }
  const std::vector<std::string> found = verifyBoth(directory, site, input).findings;
  for (const std::size_t i : {0, 1, 2})
    EXPECT_EQ(std::ranges::any_of(found,
                                  [&](const std::string& sentence) {
                                    return sentence.starts_with("Shape ") &&
                                           sentence.find(groups[i].string()) != sentence.npos;
                                  }),
              i != 1)
        << ::testing::PrintToString(found);
}

TEST(ComparisonOfSeveralMeshes, SaysWhereShapesAreNotAsMany) {
  const TemporaryDirectory directory;
  const Mesh mesh = roughTorus(60, 40, {0, 0, 0});
  writeGlb(directory / "input.glb", {mesh, roughTorus(70, 40, {4, 0, 0})});
  convert(directory / "input.glb", directory / "site", smallGroups());
  writeGlb(directory / "other.glb", {mesh});
  EXPECT_EQ(verifyBoth(directory, directory / "site", directory / "other.glb").findings,
            std::vector<std::string>{"The site has 2 shapes, the input 1."});
}

TEST(ComparisonOfSeveralMeshes, SaysWhichShapesStandElsewhere) {
  const TemporaryDirectory directory;
  GltfText gltf;
  const std::size_t first = gltf.addMesh({primitiveOf(gltf, roughTorus(60, 40, {0, 0, 0}), false)}),
                    second = gltf.addMesh({primitiveOf(gltf, roughTorus(70, 40, {4, 0, 0}), false)});
  for (const std::size_t mesh : {first, second, first})
    gltf.show(mesh);
  writeFile(directory / "input.glb", gltf.glb());
  convert(directory / "input.glb", directory / "site", smallGroups());
  EXPECT_TRUE(verifyBoth(directory, directory / "site", directory / "input.glb").equal);
  gltf.json["nodes"][2]["translation"] = {0, 1, 0};
  writeFile(directory / "moved.glb", gltf.glb());
  EXPECT_EQ(verifyBoth(directory, directory / "site", directory / "moved.glb").findings,
            std::vector<std::string>{"1 of 3 shapes stand elsewhere than in the input."});
}

TEST(ComparisonOfSeveralMeshes, ComparesInstancesOfOthersInMemory) {
  const TemporaryDirectory directory;
  const Mesh mesh = roughTorus(60, 40, {0, 0, 0});
  Mesh moved = mesh;
  for (Vec3f& position : moved.positions)
    position += Vec3f{4, 0, 0};
  const std::filesystem::path input = directory / "input.glb";
  writeGlb(input, {mesh, moved, roughTorus(70, 40, {8, 0, 0})});
  ASSERT_EQ(convert(input, directory / "site", smallGroups()).instances.shapes, 1u);
  const VerifyReport report = verifyBoth(directory, directory / "site", input);
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  EXPECT_EQ(report.instances, 1u);
  writeGlb(input, {mesh, moved}); // nothing is left that is large
  convert(input, directory / "pair", smallGroups());
  EXPECT_TRUE(verifyBoth(directory, directory / "pair", input).equal);
}

TEST(ComparisonOfSeveralMeshes, IsInMemoryWhereThatHoldsAllMeshesAndTheComparisonOfTheLargest) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "several.glb";
  writeFile(input, testing::largeMeshAndSmallOnes(130)); // 540,000 triangles
  ConvertOptions options = smallGroups();
  options.groupTriangles = 4096;
  options.findInstances = false;
  convert(input, directory / "site", options);
  const SiteDocument document = openDocument(directory / "site");
  const std::optional<SiteManifest> manifest = manifestOf(document);
  const auto chosen = [&](VerifyOptions given) {
    return chooseComparison(document, manifest, directory / "site", input, given);
  };
  const std::uint64_t needed = verifyMemoryInCore(540'000, 24'000);
  EXPECT_LT(needed, testing::minVerifyingMemory);
  EXPECT_GT(verifyMemoryInCore(540'000, 540'000), testing::minVerifyingMemory);
  EXPECT_FALSE(chosen({.memoryBytes = testing::minVerifyingMemory}));
  const std::optional<ChosenComparison> asked = chosen({.workFolder = directory / "work"});
  ASSERT_TRUE(asked);
  EXPECT_TRUE(asked->storesWhole);
  EXPECT_EQ(asked->large.size(), 1u);
  EXPECT_TRUE(verify(directory / "site", input, {.memoryBytes = testing::minVerifyingMemory}).equal);
}

} // namespace
} // namespace imgeo
