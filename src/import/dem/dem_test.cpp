#include "base/file.h"
#include "base/testing.h"
#include "containers/png/png.h"
#include "import/dem/testing.h"
#include "import/testing.h"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numbers>

namespace imgeo::testing {
namespace {

/// An ASCII grid of 4 x 3 cells, 10 wide, with one hole.
const std::string asciiGrid = "ncols 4\nnrows 3\nxllcorner 500000\nyllcorner 4000000\ncellsize 10\nNODATA_value -9999\n"
                              "1 2 3 4\n5 6 7 8\n9 10 11 -9999\n";

/// The values of the MetadataSet that a source's only Shape has, by name.
std::map<std::string, std::string> georeferenceOf(const Imported& imported) {
  const SceneGraph& graph = imported.scene.graph;
  const Node& set = graph.nodes.at(graph.nodes.at(graph.roots.at(0)).children.at(0));
  EXPECT_EQ(std::get<GenericNode>(set.content).element, "MetadataSet");
  std::map<std::string, std::string> values;
  for (const std::size_t child : set.children) {
    const auto field = [&](const char* name) {
      return std::ranges::find(graph.nodes[child].fields, name, &FieldText::name)->value;
    };
    EXPECT_EQ(field("containerField"), "value");
    values[field("name")] = field("value");
  }
  return values;
}

TEST(Dem, IsASurfaceInMetresWithHolesWhereThereIsNoData) {
  const Imported imported = importBytes(asBytes(asciiGrid), "hills.asc");
  EXPECT_EQ(imported.format, "AAIGrid");
  EXPECT_TRUE(imported.warnings.empty());
  EXPECT_EQ(imported.up, AxisDirection::y);
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.positions.size(), 11u);
  EXPECT_EQ(mesh.elementCount(), 11u);                // of 12, one has the cell without data
  EXPECT_EQ(mesh.positions[0], (Vec3f{-15, 1, -10})); // west, in the north
  const Box3d box = boxOf(mesh);
  EXPECT_EQ(box.min, (Vec3d{-15, 1, -10}));
  EXPECT_EQ(box.max, (Vec3d{15, 11, 10}));
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    const Vec3f a = mesh.cornerPosition(corner), b = mesh.cornerPosition(corner + 1),
                c = mesh.cornerPosition(corner + 2);
    EXPECT_GT(cross(b - a, c - a).y, 0); // seen from above
  }
  const auto values = georeferenceOf(imported);
  EXPECT_EQ(values.at("cells"), "4 3");
  EXPECT_EQ(values.at("geoTransform"), "500000 10 0 4000030 0 -10");
  EXPECT_EQ(values.at("origin"), "500020 4000015");
  EXPECT_EQ(values.at("metresPerUnit"), "1 1");
  EXPECT_EQ(values.at("noData"), "-9999");
  EXPECT_EQ(values.count("crs"), 0u);
}

TEST(Dem, TakesItsUnitsFromTheFileBesideItThatStatesThem) {
  const TemporaryDirectory directory;
  const auto write = [&](const std::string& name, const std::string& text) {
    writeFile(directory / name, asBytes(text));
  };
  write("hills.asc", asciiGrid);
  write("hills.prj",
        R"(PROJCS["feet",GEOGCS["NAD83",DATUM["North_American_Datum_1983",SPHEROID["GRS 1980",6378137,298.257222101]],
    PRIMEM["Greenwich",0],UNIT["degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic_1SP"],
    PARAMETER["latitude_of_origin",35],PARAMETER["central_meridian",-86],PARAMETER["scale_factor",1],
    PARAMETER["false_easting",600000],PARAMETER["false_northing",0],UNIT["US survey foot",0.304800609601219]])");
  const Imported imported = importFile(directory / "hills.asc");
  EXPECT_NEAR(boxOf(imported.scene.meshes[0]).size().x, 30 * 1200.0 / 3937, 1e-5);
  EXPECT_EQ(boxOf(imported.scene.meshes[0]).size().y, 10);
  EXPECT_NE(georeferenceOf(imported).at("wkt").find("US survey foot"), std::string::npos);
  // A reader of bytes alone has no folder.
  EXPECT_EQ(boxOf(onlyMesh(asciiGrid, "hills.asc")).size().x, 30);
}

TEST(Dem, ReadsRawNumbersThatBeginLikeUtf16) {
  const TemporaryDirectory directory;
  const std::string header = "NROWS 3\nNCOLS 4\nNBITS 16\nPIXELTYPE SIGNEDINT\nBYTEORDER I\nLAYOUT BIL\n"
                             "ULXMAP 500005\nULYMAP 4000025\nXDIM 10\nYDIM 10\n";
  writeFile(directory / "hills.hdr", asBytes(header));
  Bytes heights;
  for (std::int16_t n = 0; n < 12; ++n)
    appendLittle(heights, static_cast<std::uint16_t>(n - 2));
  ASSERT_EQ(heights[0], 0xfe);
  writeFile(directory / "hills.bil", heights);
  const Imported imported = importFile(directory / "hills.bil");
  EXPECT_EQ(imported.format, "EHdr");
  EXPECT_EQ(boxOf(imported.scene.meshes[0]).min, (Vec3d{-15, -2, -10}));
  EXPECT_EQ(boxOf(imported.scene.meshes[0]).max, (Vec3d{15, 9, 10}));
}

/// Hills of 12 x 9 cells.
TiffGrid hills() {
  TiffGrid grid{.columns = 12, .rows = 9};
  for (int n = 0; n < 12 * 9; ++n)
    grid.heights.push_back(static_cast<float>(100 + 20 * std::sin(n % 12) * std::cos(n / 12))); // NOLINT: whole rows
  return grid;
}

TEST(Dem, ScalesDegreesToMetresAtTheLatitudeOfItsCentre) {
  TiffGrid grid = hills();
  grid.modelType = 2;
  grid.epsg = 4326;
  grid.cell = 0.001;
  grid.corner = {-84, 60.0045};
  grid.noData = "-32768";
  grid.heights[0] = -32768;
  const Imported imported = importBytes(tiffOf(grid), "hills.tif");
  EXPECT_EQ(imported.format, "GeoTIFF");
  const Vec3d size = boxOf(imported.scene.meshes[0]).size();
  // WGS 84 at 60 degrees: a degree is 55,800 m to the east and 111,412 m to the north.
  EXPECT_NEAR(size.x, 11 * 55.8, 0.1);
  EXPECT_NEAR(size.z, 8 * 111.412, 0.1);
  EXPECT_EQ(imported.scene.meshes[0].positions.size(), 107u);
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_EQ(imported.warnings[0], "Its coordinates are degrees: cells are 55.8 m by 111.4 m, as at its centre, at a "
                                  "latitude of 60 degrees.");
  const auto values = georeferenceOf(imported);
  EXPECT_EQ(values.at("crs"), "\"EPSG:4326\"");
  EXPECT_EQ(values.at("crsName"), "\"WGS 84\"");

  grid.modelType = 0;
  grid.epsg = 0;
  EXPECT_EQ(boxOf(onlyMesh(tiffOf(grid), "hills.tif")).size(), size); // as metres its relief would be steeper than wide
  grid.modelType = 1;
  grid.epsg = 32617; // a zone of UTM
  grid.cell = 30;
  grid.corner = {700000, 4000000};
  EXPECT_EQ(boxOf(onlyMesh(tiffOf(grid), "hills.tif")).size().x, 330);
}

Bytes pngOf(std::uint32_t channels, const std::function<std::uint8_t(std::uint32_t n, std::uint32_t channel)>& value) {
  Image image{8, 8, channels, {}};
  for (std::uint32_t n = 0; n < 64; ++n)
    for (std::uint32_t channel = 0; channel < channels; ++channel)
      image.pixels.push_back(value(n, channel));
  return encodePng(image, 1);
}

TEST(Dem, IsAGreyImageOfAnyNameWhoseHeightsAreATenthOfItsWidth) {
  const auto grey = [](std::uint32_t n, std::uint32_t) { return static_cast<std::uint8_t>(3 * n); };
  for (const std::uint32_t channels : {1u, 3u}) {
    const Imported imported = importBytes(pngOf(channels, grey), "picture");
    EXPECT_EQ(imported.format, "PNG");
    EXPECT_EQ(imported.scene.meshes[0].elementCount(), 98u);
    EXPECT_NEAR(boxOf(imported.scene.meshes[0]).size().y, 0.7, 1e-6);
    ASSERT_EQ(imported.warnings.size(), 1u);
    EXPECT_NE(imported.warnings[0].find("heights of 0 to 189 are spread over 0.7 m"), std::string::npos);
  }
  const Error error = errorOf(
      pngOf(3, [](std::uint32_t n, std::uint32_t c) { return static_cast<std::uint8_t>(n * (c + 1)); }), "photo.png");
  EXPECT_EQ(error.kind(), ErrorKind::unsupported);
  EXPECT_EQ(error.message(), "is a picture in colours; heights are a grey image, or one band");
}

TEST(Dem, IsRefusedIfItIsTooLargeOrHasNoSurface) {
  TiffGrid grid = hills();
  grid.columns = grid.rows = 100000;
  const Error large = errorOf(tiffOf(grid), "large.tif");
  EXPECT_EQ(large.kind(), ErrorKind::limit);
  EXPECT_EQ(large.message(), "has 100000 x 100000 heights, more than the 33554432 that are read; gdal_translate "
                             "-outsize 5792 5792 -r average makes it coarser");
  EXPECT_EQ(errorOf("ncols 1\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\n1\n2\n3\n", "a.asc").message(),
            "a grid of 1 x 3 heights has no surface");
  const std::string head = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value 0\n";
  EXPECT_EQ(errorOf(head + "0 0\n0 0\n", "a.asc").message(), "has no cell with a height");
  EXPECT_EQ(errorOf(head + "1 0\n0 1\n", "a.asc").message(), "has no three neighbouring cells with heights");
  EXPECT_EQ(onlyMesh(head + "1 0\n1 1\n", "a.asc").elementCount(), 1u);
}

TEST(Dem, IsRefusedIfItIsDamagedOrNamesOtherFiles) {
  Bytes cut = tiffOf(hills());
  cut.resize(cut.size() - 50);
  EXPECT_EQ(errorOf(cut, "cut.tif").kind(), ErrorKind::malformed);

  const TemporaryDirectory directory;
  writeFile(directory / "hills.tif", tiffOf(hills()));
  const std::string vrt = fmt::format("<VRTDataset rasterXSize='12' rasterYSize='9'><VRTRasterBand dataType='Float32' "
                                      "band='1'><SimpleSource><SourceFilename>{}</SourceFilename></SimpleSource>"
                                      "</VRTRasterBand></VRTDataset>",
                                      (directory / "hills.tif").string());
  writeFile(directory / "names.tif", asBytes(vrt));
  try {
    importFile(directory / "names.tif");
    FAIL() << "a virtual raster was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::malformed);
    EXPECT_NE(error.message().find("is damaged or no grid of heights"), std::string::npos);
  }
}

} // namespace
} // namespace imgeo::testing
