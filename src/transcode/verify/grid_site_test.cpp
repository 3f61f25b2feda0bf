// Reads pages whose ImageGeometry is a grid: a height map, a geometry image, a sculpt. The tests write the images.

#include "base/error.h"
#include "containers/png/png.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

constexpr std::uint32_t gridColumns = 24, gridRows = 15;

/// A point of a grid, 0..1 in each axis of its box.
using GridPoint = std::function<Vec3d(double u, double v)>;

/// The image of the high bytes (plane 0) or of the low bytes (plane 1) of 16-bit coordinates.
Bytes planeOf(const GridPoint& point, int plane) {
  Image image{gridColumns, gridRows, 3, {}};
  for (std::uint32_t n = 0; n < gridColumns * gridRows; ++n) {
    const Vec3d at =
        point((n % gridColumns) / (gridColumns - 1.0), (n / gridColumns) / (gridRows - 1.0)); // NOLINT: whole rows
    for (int axis = 0; axis < 3; ++axis)
      image.pixels.push_back(static_cast<std::uint8_t>(std::lround(65535 * at[axis]) >> (plane == 0 ? 8 : 0)));
  }
  return encodePng(image, 1);
}

Vec3d hillPoint(double u, double v) {
  return {0.5 + 0.5 * std::sin(7 * u) * std::cos(5 * v), 0, 0};
}

Vec3d vase(double u, double v) {
  const double radius = v == 0 ? 0 : 0.3 + 0.2 * v, angle = 2 * std::numbers::pi * u * (gridColumns - 1) / gridColumns;
  return {0.5 + radius * std::sin(angle), 1 - v, 0.5 + radius * std::cos(angle)};
}

void writePage(const TemporaryDirectory& directory, const char* mode, const GridPoint& point,
               const std::string& fields = {}) {
  writeFile(directory / "0.png", planeOf(point, 0));
  writeFile(directory / "1.png", planeOf(point, 1));
  writeFile(directory / "index.html",
            asBytes(fmt::format("<!DOCTYPE html><html><body><X3D><Scene><Shape><Appearance><Material></Material>"
                                "</Appearance><ImageGeometry implicitMeshMode='{}' implicitMeshSize='{} {}' "
                                "position='100 3 0' size='46 2 28' coord='\"0.png\" \"1.png\"' {}></ImageGeometry>"
                                "</Shape></Scene></X3D></body></html>",
                                mode, gridColumns, gridRows, fields)));
}

struct GridCase {
  const char* mode;
  GridPoint point;
  std::size_t triangles, vertices;
};

const GridCase gridCases[] = {
    {"HEIGHTMAP", hillPoint, 2 * (gridColumns - 1) * (gridRows - 1), gridColumns* gridRows},
    {"geometryImage", vase, 2 * (gridColumns - 1) * (gridRows - 1) - (gridColumns - 1), gridColumns*(gridRows - 1) + 1},
    {"sculpt", vase, 2 * gridColumns*(gridRows - 1) - gridColumns, gridColumns*(gridRows - 1) + 1},
};

TEST(GridSite, IsInspectedReadExportedVerifiedAndConverted) {
  for (const GridCase& grid : gridCases) {
    SCOPED_TRACE(grid.mode);
    const TemporaryDirectory directory;
    writePage(directory, grid.mode, grid.point);
    EXPECT_GE(inspect(directory.path()).elements.triangles, grid.triangles); // poles have triangles without area
    const Mesh mesh = readMeshes(openDocument(directory.path())).meshes.at(0);
    EXPECT_EQ(mesh.elementCount(), grid.triangles);
    EXPECT_EQ(mesh.positions.size(), grid.vertices);
    EXPECT_FALSE(mesh.normals.empty());

    EXPECT_EQ(exportSite(directory.path(), directory / "out.ply").elements.triangles, grid.triangles);
    const VerifyReport verified = verify(directory.path(), directory / "out.ply");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    EXPECT_EQ(verified.site.triangles, grid.triangles);

    ConvertOptions options;
    options.pictures = false;
    options.positionBits = 20;
    const ConvertReport converted = convert(directory / "index.html", directory / "new", options);
    EXPECT_EQ(converted.elements.triangles, grid.triangles);
    EXPECT_TRUE(converted.warnings.empty()) << converted.warnings[0];
    EXPECT_TRUE(verify(directory / "new", directory / "index.html").equal);
  }
}

TEST(GridSite, HasTheHeightsAboveItsColumnsAndRows) {
  const TemporaryDirectory directory;
  writePage(directory, "heightMap", hillPoint, "priority='2'");
  const Mesh mesh = readMeshes(openDocument(directory.path())).meshes.at(0);
  const Box3d box = boxOf(mesh);
  EXPECT_EQ(box.min.x, 100 - 23);
  EXPECT_EQ(box.max.z, 14);
  for (const Vec3f& p : mesh.positions) {
    const double height = hillPoint((p.x - 77) / 46, (p.z + 14) / 28).x;
    ASSERT_NEAR(p.y, 2 + 2 * height, 1e-4);
  }
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.message();
  }
  return "";
}

TEST(GridSite, IsRefusedIfItsSizeOrModeHasNoMeaning) {
  const TemporaryDirectory directory;
  const auto refusal = [&](const char* mode, const std::string& fields) {
    writePage(directory, mode, hillPoint, fields);
    return messageOf([&] { readMeshes(openDocument(directory.path())); });
  };
  EXPECT_EQ(refusal("volume", ""),
            "implicitMeshMode=\"volume\" is none of auto, sig, heightMap, geometryImage, sculpt");
  EXPECT_EQ(
      refusal("heightMap", "><GeometryPatch implicitMeshSize='1 5' coord='0.png'></GeometryPatch></ImageGeometry"),
      "a grid of 1 x 5 vertices has no surface");
  EXPECT_EQ(
      refusal("sculpt", "><GeometryPatch implicitMeshSize='5 5000' coord='0.png'></GeometryPatch></ImageGeometry"),
      "a grid has more than 4096 columns or rows");
  const std::string patch = "<GeometryPatch implicitMeshSize='5 5' coord='0.png'></GeometryPatch>";
  EXPECT_EQ(refusal("heightMap", "><GeometryPatch gridOrigin='-1 0' implicitMeshSize='5 5' coord='0.png'>"
                                 "</GeometryPatch></ImageGeometry"),
            "gridOrigin is no column and row");
  EXPECT_EQ(refusal("heightMap", "><GeometryPatch gridOrigin='65535 0' implicitMeshSize='5 5' coord='0.png'>"
                                 "</GeometryPatch></ImageGeometry"),
            "a height map has more than 65536 columns or rows");
  EXPECT_EQ(refusal("sculpt", ">" + patch + patch + "</ImageGeometry"), "");
  EXPECT_EQ(refusal("sculpt", "><GeometryPatch implicitMeshSize='30 5' coord='0.png'></GeometryPatch></ImageGeometry"),
            "the image is 24 texels wide and cannot hold 30 columns");
}

} // namespace
} // namespace imgeo
