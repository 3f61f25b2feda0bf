// Converts files of several meshes and clouds out of core, the large ones one after the other.

#include "base/soak_testing.h"
#include "transcode/site/site_document.h"
#include "transcode/verify/large_comparison_testing.h"
#include "transcode/verify/out_of_core_testing.h"
#include "transcode/verify/several_meshes_testing.h"

#include <gtest/gtest.h>
#include <thread>

namespace imgeo {
namespace {

using testing::documentOf;
using testing::GltfText;
using testing::outOfCore;
using testing::primitiveOf;
using testing::refusal;
using testing::roughTorus;
using testing::severalMeshes;
using testing::severalScans;
using testing::TemporaryDirectory;
using testing::withRegions;

/// A document without its viewpoints, which out of core are made from coarse levels.
std::string withoutViewpoints(std::string document) {
  for (std::size_t begin = document.find("<Viewpoint"); begin != document.npos; begin = document.find("<Viewpoint"))
    document.erase(begin, document.find('>', begin) - begin);
  return document;
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemory) {
  const TemporaryDirectory directory;
  writeFile(directory / "several.glb", severalMeshes());
  testing::expectSameAsInMemory(directory, directory / "several.glb");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  const SiteInfo info = inspect(directory / "site");
  EXPECT_EQ(info.warnings, std::vector<std::string>());
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForScansOfE57) {
  const TemporaryDirectory directory;
  writeFile(directory / "scans.e57", severalScans());
  testing::expectSameAsInMemory(directory, directory / "scans.e57", [](ConvertOptions options) {
    options.keepAttributes.all = true;
    return options;
  });
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForObjectsAndMaterialsOfObj) {
  const TemporaryDirectory directory;
  testing::writeSeveralObjects(directory / "house.obj");
  testing::expectSameAsInMemory(directory, directory / "house.obj");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  ConvertOptions options = outOfCore(directory);
  options.force = true;
  ConvertOptions inMemory = withRegions();
  inMemory.force = true;
  EXPECT_EQ(convert(directory / "house.obj", directory / "site", options).warnings,
            convert(directory / "house.obj", directory / "memory", inMemory).warnings);
}

void convertTextures(const char* encoding) {
  const TemporaryDirectory directory;
  testing::writeTexturedPly(directory / "torus.ply", encoding);
  testing::expectSameAsInMemory(directory, directory / "torus.ply");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  EXPECT_NE(documentOf(directory / "site").find("c.png"), std::string::npos);
}

SOAK_TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForTexturesOfPly) {
  convertTextures("binary_little_endian");
}

SOAK_TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForTexturesOfTextPly) {
  convertTextures("ascii");
}

void convertOneTexture(const char* encoding) {
  const TemporaryDirectory directory;
  testing::writeTexturedPly(directory / "torus.ply", encoding, true);
  testing::expectSameAsInMemory(directory, directory / "torus.ply");
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
  EXPECT_NE(documentOf(directory / "site").find("ImageTexture"), std::string::npos);
  EXPECT_TRUE(std::ranges::any_of(openDocument(directory / "site").scene.geometries,
                                  [](const GeometryDescription& geometry) { return geometry.levels->chipSet > 0; }));
  const VerifyReport large = testing::verifyBoth(directory, directory / "site", directory / "torus.ply");
  EXPECT_TRUE(large.equal) << ::testing::PrintToString(large.findings);
}

SOAK_TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForTheOneTextureOfPly) {
  convertOneTexture("ascii");
}

SOAK_TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForTheOneTextureOfBinaryPly) {
  convertOneTexture("binary_big_endian");
}

TEST(SeveralMeshesOutOfCore, HaveTheFilesAndTheDocumentOfConversionInMemoryForScansOfPts) {
  const TemporaryDirectory directory;
  writeFile(directory / "scans.pts", asBytes(testing::severalPtsScans()));
  testing::expectSameAsInMemory(directory, directory / "scans.pts", [](ConvertOptions options) {
    options.keepAttributes.all = true;
    return options;
  });
  EXPECT_EQ(withoutViewpoints(documentOf(directory / "site")), withoutViewpoints(documentOf(directory / "memory")));
}

SOAK_TEST(SeveralMeshesOutOfCore, GoOnWhereTheyWereEndedInAnyPass) {
  const TemporaryDirectory directory;
  GltfText gltf;
  for (const int rings : {60, 70})
    gltf.show(gltf.addMesh({primitiveOf(gltf, roughTorus(rings, 40, {0, 0, 0}), true)}));
  writeFile(directory / "several.glb", gltf.glb());
  const std::set<std::string> steps =
      testing::expectGoesOnInAnyPass(directory, directory / "several.glb", "groups-0-0");
  for (const char* mesh : {"mesh 1 of 2: ", "mesh 2 of 2: "})
    EXPECT_TRUE(std::ranges::any_of(steps, [&](const std::string& step) { return step.starts_with(mesh); })) << mesh;
}

TEST(SeveralMeshesOutOfCore, AreSharedByRanks) {
  const TemporaryDirectory directory;
  const std::filesystem::path input = directory / "several.glb";
  writeFile(input, severalMeshes());
  convert(input, directory / "memory", withRegions());
  std::vector<std::thread> ranks;
  std::vector<std::string> sentences(3);
  for (std::uint32_t rank = 0; rank < sentences.size(); ++rank)
    ranks.emplace_back([&, rank] {
      ConvertOptions options = outOfCore(directory);
      options.ranks.rank = rank;
      options.ranks.count = static_cast<std::uint32_t>(sentences.size());
      sentences[rank] = refusal(input, directory / "site", options);
    });
  for (std::thread& rank : ranks)
    rank.join();
  EXPECT_EQ(sentences, std::vector<std::string>(3));
  EXPECT_EQ(testing::contentsOf(directory / "site" / "geometry"),
            testing::contentsOf(directory / "memory" / "geometry"));
}

} // namespace
} // namespace imgeo
