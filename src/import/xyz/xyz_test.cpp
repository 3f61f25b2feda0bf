#include "import/testing.h"

#include "import/format.h"
#include "import/mesh/point_cloud_testing.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {

namespace {

using testing::keepingAll;
using testing::onlyMesh;
using testing::refusalOf;

TEST(Xyz, ALineOfNamesSaysWhatTheNumbersAre) {
  for (const char* header : {"# X Y Z Red Green Blue Heat\n", "//X;Y;Z;R;G;B;Heat\n", "x,y,z,r,g,b,Heat\r\n",
                             "a scan\n# of a wall\n# x y z r g b Heat\n"}) {
    const Mesh mesh =
        onlyMesh(header + std::string("1.5 2 -3 255 0 51 20.5\n\n0,0,0,0,255,0,-1e1\n"), "a.xyz", keepingAll());
    EXPECT_EQ(mesh.topology, Topology::points) << header;
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{1.5, 2, -3}, {0, 0, 0}})) << header;
    EXPECT_EQ(mesh.colors.at(0), Rgba(Rgba8{255, 0, 51, 255})) << header;
    ASSERT_EQ(mesh.namedAttributes.size(), 1u) << header;
    EXPECT_EQ(mesh.namedAttributes[0].name, "Heat");
    EXPECT_EQ(mesh.namedAttributes[0].values, (std::vector<float>{20.5, -10}));
  }
  const Mesh turned = onlyMesh("nz,ny,nx,z,y,x\n1,0,0,3,2,1\n0,3,4,6,5,4.5\n", "a.csv");
  EXPECT_EQ(turned.positions[1], (Vec3f{4.5, 5, 6}));
  EXPECT_EQ(turned.normals, (std::vector<Vec3f>{{0, 0, 1}, Vec3f{0.8f, 0.6f, 0}}));
}

TEST(Xyz, WithoutNamesTheValuesSayWhatTheNumbersAre) {
  EXPECT_EQ(onlyMesh("1 2 3\n4 5 6.5\n7 8 9\n", "a.xyz").positions.size(), 3u);
  EXPECT_EQ(onlyMesh("1 2 3 0 0 1\n4 5 6 0.6 0 -0.8\n", "a.pwn").normals,
            (std::vector<Vec3f>{{0, 0, 1}, Vec3f{0.6f, 0, -0.8f}}));
  EXPECT_EQ(onlyMesh("1 2 3 255 0 51\n4 5 6 0 0 0\n", "a.txt").colors[0], Rgba(Rgba8{255, 0, 51, 255}));
  EXPECT_EQ(onlyMesh("1 2 3 1 0.5 0\n4 5 6 0 0 0.25\n", "a.txt").colors[0], Rgba(1, 0.5, 0, 1));

  const Mesh intensities = onlyMesh("1 2 3 200 255 0 51\n4 5 6 201 0 0 255\n", "a.asc", keepingAll());
  EXPECT_EQ(intensities.colors[1], Rgba(0, 0, 1, 1));
  EXPECT_EQ(intensities.namedAttributes.at(0).name, "intensity");
  EXPECT_EQ(intensities.namedAttributes[0].values, (std::vector<float>{200, 201}));

  const Mesh all = onlyMesh("1 2 3 255 0 51 0 1 0 7\n4 5 6 0 0 255 1 0 0 8\n", "a.pts", keepingAll());
  EXPECT_EQ(all.colors[1], Rgba(0, 0, 1, 1));
  EXPECT_EQ(all.normals[0], (Vec3f{0, 1, 0}));
  EXPECT_EQ(all.namedAttributes.at(0).values, (std::vector<float>{7, 8}));
}

TEST(Xyz, ASentenceOfAsManyWordsIsNoLineOfNames) {
  for (const char* before : {"# made by the first scanner today\n", "made by a scanner today too\n"})
    EXPECT_EQ(onlyMesh(before + std::string("1 2 3 0 0 1\n4 5 6 0.6 0 -0.8\n"), "a.xyz").normals.size(), 2u) << before;
  const Imported table = importBytes(asBytes("East;North;Height;Heat\n1;2;3;4\n5;6;7;8\n"), "a.csv");
  EXPECT_EQ(table.attributes, std::vector<std::string>{"Heat"});
}

TEST(Xyz, FurtherValuesAreNamedByTheirColumnsAndCanBeKept) {
  const Imported imported = importBytes(asBytes("1 2 3 -5 700\n4 5 6 -6 800\n"), "a.xyz");
  EXPECT_EQ(imported.attributes, (std::vector<std::string>{"column4", "column5"}));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"Not carried over from the XYZ file: column4, column5."});
  EXPECT_EQ(imported.format, "XYZ");
  EXPECT_EQ(imported.up, AxisDirection::z);
}

TEST(Xyz, ColoursMayHave16Bits) {
  const Mesh mesh = onlyMesh("x y z red green blue\n1 2 3 65535 0 13107\n4 5 6 0 0 0\n", "a.txt");
  EXPECT_EQ(mesh.colors[0], Rgba(1, 0, 0.2f, 1));
}

TEST(Xyz, CoordinatesFarFromZeroAreStoredAroundAnOrigin) {
  const Imported imported = importBytes(asBytes("500000.001 5800000.25 100\n500002.002 5800001.5 101\n"), "b.xyz");
  EXPECT_EQ(imported.origin, (Vec3d{500001, 5800000, 100}));
  const std::vector<Vec3f>& positions = imported.scene.meshes[0].positions;
  EXPECT_NEAR(positions[1].x - positions[0].x, 2.001, 1e-6);
}

TEST(Xyz, GridsOfHeightsAndCountedScansAreLeftToTheirReaders) {
  const auto formatNameOf = [](const std::string& text, const char* name) {
    return formatOf(asBytes(text), name).name;
  };
  const std::string byRow = "0 0 5\n1 0 5\n3 0 5\n0 1 5\n1 1 5\n", byColumn = "0 9 5\n0 8 5\n1 9 5\n1 8 5\n";
  EXPECT_EQ(formatNameOf(byRow, "a.xyz"), "GeoTIFF and other grids of heights");
  EXPECT_EQ(formatNameOf(byColumn, "a.xyz"), "GeoTIFF and other grids of heights");
  EXPECT_EQ(formatNameOf("ncols 2\nnrows 2\n1 2\n3 4\n", "a.asc"), "GeoTIFF and other grids of heights");
  EXPECT_EQ(formatNameOf("2\n1 2 3\n4 5 6\n", "a.pts"), "PTS");
  EXPECT_EQ(formatNameOf(byRow, "a.txt"), "XYZ");
  // The corners of a cube, a third layer of cells, a single row.
  EXPECT_EQ(formatNameOf("-1 -1 -1\n-1 1 -1\n1 1 -1\n1 -1 -1\n", "a.xyz"), "XYZ");
  EXPECT_EQ(formatNameOf(byRow + "0 0 6\n", "a.xyz"), "XYZ");
  EXPECT_EQ(formatNameOf("0 0 5\n1 0 5\n2 0 5\n", "a.xyz"), "XYZ");
  EXPECT_EQ(formatNameOf("1 2 3\n4 5 6\n", "a.pts"), "XYZ");
}

TEST(Xyz, LinesMayEndWithCarriageReturnsAlone) {
  EXPECT_EQ(onlyMesh("1.5 2 -3\r0 0 0\r", "a.xyz").positions, (std::vector<Vec3f>{{1.5, 2, -3}, {0, 0, 0}}));
}

TEST(Xyz, DamageIsRefusedWithItsLine) {
  const auto refused = [](std::string_view text) { return refusalOf(text, "a.txt"); };
  EXPECT_EQ(refused("1 2 3\n\n1 2 3 4\n"), "a.txt:3: a point has 4 numbers, and those before have 3");
  EXPECT_EQ(refused("1 2 3\n1 two 3\n"), "a.txt:2: a number expected, not 'two'");
  EXPECT_EQ(refused("1 2 3\n1 2 nan\n"), "a.txt:2: a coordinate is not a number or beyond single precision");
  EXPECT_EQ(refused("x y z\n1 2\n"), "a.txt:2: a line of at least three numbers expected: x, y and z of a point");
  EXPECT_EQ(refused("x y z\ny z x\n"), "a.txt:2: a line of at least three numbers expected: x, y and z of a point");
  EXPECT_EQ(refused("# x y z\n\n"), "a.txt: has no points");
  std::string line = "1 2 3";
  for (int n = 0; n < 64; ++n)
    line += " 4";
  EXPECT_EQ(refused("1 2 3\n" + line), "a.txt:2: a line has more than 64 numbers");
}

} // namespace

} // namespace imgeo
