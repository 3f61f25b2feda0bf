#include "base/file.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/imgeo.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

const SourceAxesOptions turnedAxes{
    .up = AxisDirection::minusX, .rotations = {{1, 30}, {0, -90}}, .scale = 2, .metres = 0.0254};

std::string textOf(const std::filesystem::path& file) {
  const Bytes bytes = readFile(file);
  return {bytes.begin(), bytes.end()};
}

TEST(Axes, OfASiteAreVerifiedAndExportedAsTheSourceHasThem) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(20, 20));
  ConvertOptions options;
  options.axes = turnedAxes;
  const ConvertReport report = convert(directory / "input.ply", directory / "site", options);
  EXPECT_EQ(report.axes.axes.up, AxisDirection::minusX);
  EXPECT_FALSE(report.axes.isGuess);
  EXPECT_NE(textOf(directory / "site" / "scene.x3d").find("<Transform"), std::string::npos);
  EXPECT_TRUE(verify(directory / "site", directory / "input.ply").equal);
  for (const char* name : {"out.ply", "out.obj"}) {
    exportSite(directory / "site", directory / name);
    EXPECT_TRUE(verify(directory / "site", directory / name).equal) << name;
  }
}

TEST(Axes, OfAnExportedGlbAreThoseOfTheDocument) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(20, 20));
  ConvertOptions options;
  options.axes = turnedAxes;
  convert(directory / "input.ply", directory / "site", options);
  exportSite(directory / "site", directory / "out.glb");
  convert(directory / "out.glb", directory / "again", {}); // the Transform has become a node
  const SiteInfo site = inspect(directory / "site");
  EXPECT_EQ(inspect(directory / "again").elements, site.elements);
  EXPECT_TRUE(verify(directory / "again", directory / "out.glb").equal);
  for (const std::string& finding : verify(directory / "site", directory / "out.glb").findings)
    EXPECT_EQ(finding.find("stand elsewhere"), std::string::npos) << finding;
}

TEST(Axes, OtherThanThoseInTheManifestAreFound) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(20, 20));
  ConvertOptions options;
  options.axes.up = AxisDirection::z;
  convert(directory / "input.ply", directory / "site", options);
  std::string manifest = textOf(directory / "site" / "imgeo.json");
  const std::size_t at = manifest.find("\"up\": \"z\"");
  ASSERT_NE(at, std::string::npos);
  manifest.replace(at, 9, "\"up\": \"x\"");
  writeFile(directory / "site" / "imgeo.json", asBytes(manifest));
  EXPECT_FALSE(verify(directory / "site", directory / "input.ply").equal);
}

TEST(Axes, OfAnX3dSourceKeepItsViewpoints) {
  const TemporaryDirectory directory;
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += std::to_string(i) + " 0 0, 1000 0 0, 0 " + std::to_string(i + 1) + " 0, ";
  writeFile(directory / "in.x3d", asBytes("<X3D><Scene><Viewpoint description='Mine' position='1 2 3'/><Shape>"
                                          "<TriangleSet><Coordinate point='" +
                                          points + "'/></TriangleSet></Shape></Scene></X3D>"));
  ConvertOptions options;
  options.axes = turnedAxes;
  convert(directory / "in.x3d", directory / "site", options);
  EXPECT_TRUE(verify(directory / "site", directory / "in.x3d").equal);
  const std::string scene = textOf(directory / "site" / "scene.x3d");
  EXPECT_LT(scene.find("<Transform"), scene.find("Mine"));
  EXPECT_EQ(scene.find("\"Front\""), std::string::npos);
  options.view = StartView::front;
  EXPECT_THROW(convert(directory / "in.x3d", directory / "site", options), Error);
}

TEST(Axes, AreGuessedForPlyAndKnownForGlb) {
  const TemporaryDirectory directory;
  Mesh cone; // stands along z
  for (int i = 0; i < 24; ++i) {
    const float angle = static_cast<float>(i) * 0.2618f;
    cone.positions.push_back({std::cos(angle), std::sin(angle), 0});
  }
  cone.positions.push_back({0, 0, 3});
  for (std::uint32_t i = 0; i < 25; ++i)
    cone.wedgePositions.push_back(i);
  for (std::uint32_t i = 0; i < 24; ++i)
    testing::addTriangle(cone, i, (i + 1) % 24, 24);
  testing::writeMesh(directory / "cone.ply", cone);
  const ConvertReport guessed = convert(directory / "cone.ply", directory / "site", {});
  EXPECT_TRUE(guessed.axes.isGuess);
  EXPECT_EQ(guessed.axes.axes.up, AxisDirection::z);
  EXPECT_TRUE(verify(directory / "site", directory / "cone.ply").equal);
  exportSite(directory / "site", directory / "cone.glb");
  const ConvertReport known = convert(directory / "cone.glb", directory / "again", {});
  EXPECT_FALSE(known.axes.isGuess);
  EXPECT_EQ(known.axes.axes, SourceAxes{});
}

TEST(View, NamesTheFirstOfSeveralViewpoints) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(20, 20));
  const auto descriptionsOf = [&](StartView view) {
    ConvertOptions options;
    options.view = view;
    convert(directory / "input.ply", directory / "site", options);
    const std::string scene = textOf(directory / "site" / "scene.x3d");
    std::vector<std::string> descriptions;
    const std::string mark = "<Viewpoint description=\"";
    for (std::size_t at = scene.find(mark); at != std::string::npos; at = scene.find(mark, at + 1))
      descriptions.push_back(scene.substr(at + mark.size(), scene.find('"', at + mark.size()) - at - mark.size()));
    return descriptions;
  };
  EXPECT_EQ(descriptionsOf(StartView::automatic),
            (std::vector<std::string>{"Start", "Front", "Left", "Back", "Right", "Top"}));
  EXPECT_EQ(descriptionsOf(StartView::right), (std::vector<std::string>{"Right", "Front", "Left", "Back", "Top"}));
  EXPECT_EQ(descriptionsOf(StartView::bottom),
            (std::vector<std::string>{"Bottom", "Front", "Left", "Back", "Right", "Top"}));
}

} // namespace
} // namespace imgeo
