#include "base/error.h"
#include "base/file.h"
#include "base/soak_testing.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// Converts `mesh`, exports the site as `name` and expects that the exported file equals the site.
void expectExportEqualsSite(const Mesh& mesh, const ConvertOptions& options, const std::string& name) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& file) { return directory.path() / file; };
  writeFile(path("in.ply"), exportScene(testing::sceneOf({mesh}), MeshFormat::ply));
  convert(path("in.ply"), path("site"), options);
  const ExportReport written = exportSite(path("site"), path(name));
  const VerifyReport report = verify(path("site"), path(name));
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  const SiteInfo info = inspect(path("site"));
  EXPECT_EQ(written.elements.points, report.site.points);
  EXPECT_EQ(report.input.triangles, report.site.triangles);
  EXPECT_LE(written.vertices, info.vertices);
}

SOAK_TEST(ExportSite, WritesEveryMeshOfEveryEncoding) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    ConvertOptions options;
    options.encoding = seed % 2 == 0 ? std::optional<Encoding>() : Encoding::bg;
    options.primitives = seed % 3 == 0 ? Primitives::strips : Primitives::triangles;
    options.positionBits = 8 + seed % 13;
    options.effort = 0;
    expectExportEqualsSite(testing::randomMesh(seed), options, "out.ply");
  }
}

TEST(ExportSite, JoinsPatchesAtTheirBorders) {
  ConvertOptions options;
  options.patchVertices = 256;
  options.effort = 0;
  const Mesh mesh = testing::torus(40, 40);
  expectExportEqualsSite(mesh, options, "out.obj");

  const TemporaryDirectory directory;
  writeFile(directory.path() / "in.ply", exportScene(testing::sceneOf({mesh}), MeshFormat::ply));
  convert(directory.path() / "in.ply", directory.path() / "site", options);
  ASSERT_GT(inspect(directory.path() / "site").patches, 5u);
  exportSite(directory.path() / "site", directory.path() / "out.ply");
  const Imported read = importFile(directory.path() / "out.ply");
  EXPECT_EQ(read.scene.meshes.at(0).wedgeCount(), mesh.wedgeCount());
  EXPECT_EQ(read.scene.meshes.at(0).elementCount(), mesh.elementCount());
}

TEST(ExportSite, WritesNavigationTypesIntoAGlb) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& file) { return directory.path() / file; };
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += std::to_string(i) + " 0 0, 1000 0 0, 0 " + std::to_string(i + 1) + " 0, ";
  writeFile(path("hall.x3d"),
            asBytes("<X3D><Scene><NavigationInfo type='\"WALK\" \"ANY\"'/><Shape><TriangleSet><Coordinate "
                    "point='" +
                    points + "'/></TriangleSet></Shape></Scene></X3D>"));
  convert(path("hall.x3d"), path("hall"), {});
  exportSite(path("hall"), path("hall.glb"));
  convert(path("hall.glb"), path("again"), {});
  const Bytes page = readFile(path("again") / "index.html");
  EXPECT_NE(std::string(page.begin(), page.end()).find("<NavigationInfo type='\"WALK\" \"ANY\"'>"), std::string::npos);
  EXPECT_TRUE(verify(path("again"), path("hall.glb")).equal);
}

TEST(ExportSite, NamesGeometryOfTheDocumentThatItLeavesOut) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& file) { return directory.path() / file; };
  const auto siteOf = [&](const std::string& shapes) {
    writeFile(path("in.x3d"), asBytes("<X3D><Scene>" + shapes + "</Scene></X3D>"));
    convert(path("in.x3d"), path("site"), {});
    return path("site");
  };
  const std::string few = "<Shape><Box/></Shape><Shape><Box/></Shape><Shape><TriangleSet><Coordinate "
                          "point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape>";
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += std::to_string(i) + " 0 0, 1000 0 0, 0 " + std::to_string(i + 1) + " 0, ";
  const ExportReport report = exportSite(
      siteOf(few + "<Shape><TriangleSet><Coordinate point='" + points + "'/></TriangleSet></Shape>"), path("out.ply"));
  EXPECT_EQ(report.shapes, 1u);
  EXPECT_EQ(report.geometryLeftOut, (std::map<std::string, std::size_t>{{"Box", 2}, {"TriangleSet", 1}}));

  const std::filesystem::path site = siteOf(few);
  try {
    exportSite(site, path("none.ply"));
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), (site / "index.html").string() +
                                             ": has no geometry in files, only in its document: Box (2), "
                                             "TriangleSet (1)");
  }
  EXPECT_FALSE(std::filesystem::exists(path("none.ply")));
}

TEST(ExportSite, RefusesAFormatThatItCannotWrite) {
  try {
    exportSite("site", "out.fbx");
    ADD_FAILURE() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
  }
}

} // namespace
} // namespace imgeo
