// Converts scenes of many small shapes and checks that few files hold them.

#include "base/parallel.h"
#include "base/soak_testing.h"
#include "scene/testing.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// Shapes of a few hundred vertices, of several kinds, and one too large to share a file.
Scene manyShapes(std::uint32_t count) {
  Scene scene;
  testing::Random random(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    Mesh mesh = testing::sphere(4 + i % 12, 5 + i % 9);
    for (Vec3f& position : mesh.positions)
      position = position * random.between(1, 1.1f);
    if (i % 5 == 0)
      for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
        mesh.colors.push_back(random.color());
    scene.meshes.push_back(std::move(mesh));
  }
  scene.meshes.push_back(testing::sphere(150, 150));
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    addRoot(scene.graph, {fmt::format("shape{}", i), Shape{i, {}, true}, {}, ""});
  return scene;
}

SiteInfo convertedTo(const TemporaryDirectory& directory, const char* site) {
  ConvertOptions options;
  options.basePercent = 0;
  convert(directory / "input.glb", directory / site, options);
  return inspect(directory / site);
}

TEST(PatchFiles, HoldManySmallShapes) {
  const TemporaryDirectory directory;
  writeFile(directory / "input.glb", exportScene(manyShapes(400), MeshFormat::glb));
  const SiteInfo info = convertedTo(directory, "site");
  EXPECT_EQ(info.patches, 401u);
  const std::size_t files = testing::namesIn(directory / "site" / "geometry").size();
  EXPECT_GE(files, 3u) << "a large shape has a file of its own, and the others are more than one holds";
  EXPECT_LE(files, 6u);

  const VerifyReport verified = verify(directory / "site", directory / "input.glb");
  EXPECT_TRUE(verified.equal) << fmt::format("{}", fmt::join(verified.findings, " "));
  EXPECT_EQ(verified.site, verified.input);
  EXPECT_EQ(exportSite(directory / "site", directory / "back.glb").shapes, 401u);
}

SOAK_TEST(PatchFiles, AreTheSameForAnyNumberOfThreads) {
  const TemporaryDirectory directory;
  writeFile(directory / "input.glb", exportScene(manyShapes(200), MeshFormat::glb));
  convertedTo(directory, "site");
  limitThreads(1);
  convertedTo(directory, "alone");
  limitThreads(0);
  EXPECT_EQ(testing::contentsOf(directory / "site"), testing::contentsOf(directory / "alone"));
}

} // namespace
} // namespace imgeo
