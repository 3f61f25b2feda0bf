// Converts elevation models, and reads the sites back.

#include "base/error.h"
#include "scene/shape_instances.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// An ASCII grid of hills, perhaps with a hole of one cell.
std::string hills(int columns, int rows, bool hasHole = true, int digits = 2) {
  std::string text = fmt::format("ncols {}\nnrows {}\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n"
                                 "NODATA_value -9999\n",
                                 columns, rows);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      text += hasHole && row == 7 && column == 9
                  ? "-9999 "
                  : fmt::format("{:.{}f} ", 300 + 80 * std::sin(column / 5.0 + row / 7.0), digits);
  return text;
}

TEST(TerrainSite, EqualsItsSourceAndKeepsItsGeoreferenceWhateverItsExaggeration) {
  const TemporaryDirectory directory;
  writeFile(directory / "hills.asc", asBytes(hills(60, 50)));
  for (const double exaggeration : {1.0, 3.0}) {
    SCOPED_TRACE(exaggeration);
    ConvertOptions options;
    options.pictures = false;
    options.axes.exaggeration = exaggeration;
    const ConvertReport report = convert(directory / "hills.asc", directory / "site", options);
    EXPECT_EQ(report.format, "AAIGrid");
    EXPECT_EQ(report.elements.triangles, 2u * 59 * 49 - 4);
    EXPECT_EQ(report.encoding, Encoding::compact);
    EXPECT_TRUE(report.warnings.empty()) << ::testing::PrintToString(report.warnings);
    const VerifyReport verified = verify(directory / "site", directory / "hills.asc");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);

    const SiteDocument document = openDocument(directory / "site");
    for (const char* name : {"geoTransform", "origin", "metresPerUnit", "noData", "cells"})
      EXPECT_NE(document.text.find(fmt::format("name=\"{}\"", name)), std::string::npos) << name;
    EXPECT_EQ(document.text.find("verticalExaggeration") != std::string::npos, exaggeration != 1);
    const SceneGraph& graph = document.scene.graph;
    EXPECT_EQ(shapeInstances(graph).at(0).worldFromShape.point({1, 1, 1}), (Vec3d{1, exaggeration, 1}));
    exportSite(directory / "site", directory / "out.ply");
    EXPECT_TRUE(verify(directory / "site", directory / "out.ply").equal);
  }
}

TEST(TerrainSite, IsAHeightMapOnRequestExactWhereHeightsAreWhole) {
  const TemporaryDirectory directory;
  ConvertOptions options;
  options.pictures = false;
  options.form = MeshForm::heightMap;
  for (const int digits : {0, 2}) {
    writeFile(directory / "hills.asc", asBytes(hills(60, 50, false, digits)));
    const ConvertReport report = convert(directory / "hills.asc", directory / "site", options);
    EXPECT_EQ(report.elements.triangles, 2u * 59 * 49);
    EXPECT_EQ(report.encoding, Encoding::classic);
    const SiteDocument document = openDocument(directory / "site");
    EXPECT_NE(document.text.find("implicitMeshMode=\"heightMap\""), std::string::npos);
    EXPECT_EQ(document.scene.geometries.at(0).patches.at(0).coord.size(), 2u);
    const VerifyReport verified = verify(directory / "site", directory / "hills.asc");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    EXPECT_EQ(verified.site.triangles, report.elements.triangles);
    EXPECT_LE(verified.positionError, digits == 0 ? 0 : 160.0 / 65535);
  }
  writeFile(directory / "holes.asc", asBytes(hills(60, 50)));
  try {
    convert(directory / "holes.asc", directory / "other", options);
    FAIL() << "a height map has a hole";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::usage);
    EXPECT_NE(error.message().find("its grid has holes"), std::string::npos) << error.message();
  }
  EXPECT_FALSE(std::filesystem::exists(directory / "other"));
}

TEST(TerrainSite, IsAHeightMapOfSeveralImagesIfItIsLarge) {
  const TemporaryDirectory directory;
  ConvertOptions options;
  options.pictures = false;
  options.form = MeshForm::heightMap;
  options.gridImageEdge = 20;
  writeFile(directory / "hills.asc", asBytes(hills(60, 39, false)));
  const ConvertReport report = convert(directory / "hills.asc", directory / "site", options);
  EXPECT_EQ(report.elements.triangles, 2u * 59 * 38);
  EXPECT_EQ(report.patches, 8u); // 59 cells in four parts, 38 in two: at most 19 in each
  EXPECT_EQ(report.grids, 8u);
  EXPECT_EQ(report.largestPatch, 16u * 20u);
  const SiteDocument document = openDocument(directory / "site");
  const GeometryDescription& geometry = document.scene.geometries.at(0);
  ASSERT_EQ(geometry.patches.size(), 8u);
  EXPECT_EQ(geometry.patches[1].gridOrigin.x, geometry.patches[0].implicitMeshSize.x - 1);
  EXPECT_EQ(geometry.patches[7].gridOrigin.x + geometry.patches[7].implicitMeshSize.x, 60u);
  EXPECT_EQ(geometry.patches[7].gridOrigin.y + geometry.patches[7].implicitMeshSize.y, 39u);
  const SiteInfo info = inspect(directory / "site");
  EXPECT_EQ(info.elements.triangles, report.elements.triangles);
  EXPECT_EQ(info.geometries.at(0).grid, "heightMap");
  const VerifyReport verified = verify(directory / "site", directory / "hills.asc");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.site.triangles, report.elements.triangles);
  EXPECT_LE(verified.positionError, 160.0 / 65535);
  exportSite(directory / "site", directory / "out.ply");
  const VerifyReport exported = verify(directory / "site", directory / "out.ply");
  EXPECT_TRUE(exported.equal) << ::testing::PrintToString(exported.findings);
  // The points of shared columns and rows are the same, bit for bit: there is no crack.
  EXPECT_EQ(readMeshes(document).meshes.at(0).positions.size(), 60u * 39);
  convert(directory / "site/index.html", directory / "again", options);
  const VerifyReport again = verify(directory / "again", directory / "site/index.html");
  EXPECT_TRUE(again.equal) << ::testing::PrintToString(again.findings);
}

} // namespace
} // namespace imgeo
