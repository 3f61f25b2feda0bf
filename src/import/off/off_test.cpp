#include "import/off/off.h"

#include "import/testing.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {

namespace {

using testing::errorOf;
using testing::onlyMesh;
using testing::refusalOf;

TEST(Off, PolygonsAreCutIntoTriangles) {
  const Mesh mesh = onlyMesh("OFF\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n3 0 2 1\n", "a.off");
  EXPECT_EQ(mesh.topology, Topology::triangles);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.corners, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 2, 1}));
  EXPECT_EQ(mesh.creaseDegrees, std::nullopt);
}

TEST(Off, CommentsEmptyLinesAndLineEndsDoNotCount) {
  const std::string text =
      "# a cube's side\nOFF\n\n 4 2 # counts\n\t\n0 0 0# first\n1 0 0\n#\n1 1 0\n\n0 1 0\n3 0 1 2\n\n"
      "3 0 2 3 # last\n# End\n";
  std::string returns = text;
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& each : {text, returns}) {
    const Imported imported = importBytes(asBytes(each), "a.off");
    EXPECT_EQ(imported.scene.meshes.at(0).positions.size(), 4u);
    EXPECT_EQ(imported.scene.meshes[0].elementCount(), 2u);
    EXPECT_EQ(imported.warnings, std::vector<std::string>());
    EXPECT_EQ(imported.format, "OFF");
  }
}

TEST(Off, CountsMayFollowTheKeywordOrStandWithoutIt) {
  const std::string rest = " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  for (const char* begin : {"OFF\n3", "OFF 3", "OFF3", "3", "#\n3"})
    EXPECT_EQ(onlyMesh(begin + rest, "a.off").elementCount(), 1u) << begin;
  EXPECT_EQ(onlyMesh("OFF\n3" + rest, "a").elementCount(), 1u); // by its content
}

TEST(Off, VerticesHaveWhatTheKeywordSays) {
  const std::string faces = "3 0 1 2\n";
  const Mesh all = onlyMesh("STCNOFF\n3 1 0\n0 0 0 0 0 2 1 0 0.5 0.25 0.5 1\n1 0 0 0 1 0 0 0 0 1 0 0\n"
                            "0 1 0 1 0 0 0 0 0 1 1 1\n" +
                                faces,
                            "a.off");
  EXPECT_EQ(all.normals, (std::vector<Vec3f>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(all.colors.at(0), Rgba(1, 0, 0.5f, 0.25f));
  EXPECT_EQ(all.texCoords, (std::vector<Vec2f>{{0.5, 1}, {0, 0}, {1, 1}}));

  for (const char* keyword : {"COFF", "OFF"}) // 0 ... 255 in three numbers, also without the C
    EXPECT_EQ(
        onlyMesh(keyword + ("\n3 1 0\n0 0 0 255 0 128\n1 0 0 0 0 0\n0 1 0 0 0 0\n" + faces), "a.off").colors.at(0),
        Rgba(Rgba8{255, 0, 128, 255}));
  EXPECT_EQ(onlyMesh("COFF\n3 1 0\n0 0 0 255 0 0 51\n1 0 0 0 0 0 255\n0 1 0 0 0 0 255\n" + faces, "a.off").colors.at(0),
            Rgba(Rgba8{255, 0, 0, 51}));
}

TEST(Off, ColoursOfPolygonsGetAWarning) {
  const Imported imported = importBytes(asBytes("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n2 0 1\n"), "a.off");
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{"Colours of polygons of the OFF file are not carried over.",
                                                         "1 face was left out: fewer than three corners."}));
}

TEST(Off, WithoutPolygonsIsACloudOfPoints) {
  const Mesh cloud = onlyMesh("NOFF\n2 0 0\n1 2 3 0 0 1\n4 5 6 1 0 0\n", "a.off");
  EXPECT_EQ(cloud.topology, Topology::points);
  EXPECT_EQ(cloud.corners, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(cloud.normals[1], (Vec3f{1, 0, 0}));
}

TEST(Off, CoordinatesFarFromZeroKeepTheirDigits) {
  const Imported imported =
      importBytes(asBytes("OFF\n3 1 0\n500000.25 0 0\n500001.125 0 0\n500000 1 0\n3 0 1 2\n"), "a.off");
  EXPECT_EQ(imported.origin, (Vec3d{500000, 0, 0}));
  EXPECT_EQ(imported.scene.meshes.at(0).positions[1], (Vec3f{1.125, 0, 0}));
}

TEST(Off, DamageIsRefusedWithItsLine) {
  const auto refused = [](std::string_view text) { return refusalOf(text, "a.off"); };
  const std::string vertices = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  EXPECT_EQ(refused(vertices + "3 0 1 3\n"), "a.off:6: a polygon names vertex 3, but there are only 3");
  EXPECT_EQ(refused(vertices + "3 0 1 -1\n"), "a.off:6: a polygon names vertex -1, but there are only 3");
  EXPECT_EQ(refused(vertices + "4 0 1 2\n"), "a.off:6: a polygon of 4 corners has 3 numbers behind that");
  EXPECT_EQ(refused(vertices + ",,\n"), "a.off:6: a line of polygons without numbers");
  EXPECT_EQ(refused(vertices + "#\n"), "a.off: ends after 0 of 1 polygons");
  EXPECT_EQ(refused("OFF\n3 1 0\n0 0 0\n1 0 0 1\n0 1 0\n"), "a.off:4: a vertex has 4 numbers, and those before have 3");
  EXPECT_EQ(refused("OFF\n1 0 0\n0 0 inf\n"), "a.off:3: a coordinate is not a number or beyond single precision");
  EXPECT_EQ(refused("NOFF\n1 0 0\n0 0 0\n"), "a.off:3: a vertex has 3 numbers, which do not fit the keyword NOFF");
  EXPECT_EQ(refused("COFF\n1 0 0\n0 0 0 1\n"), "a.off:3: a vertex has 4 numbers, which do not fit the keyword COFF");
  EXPECT_EQ(refused("OFF\n99 0 0\n0 0 0\n"), "a.off:2: 99 vertices are promised, but only 6 bytes follow");
  EXPECT_EQ(refused("OFF\n-1 0 0\n"), "a.off:2: the number of vertices expected, not '-1'");
  EXPECT_EQ(refused("OFF\n1\n"), "a.off:2: the numbers of vertices, polygons and edges expected");
  EXPECT_EQ(refused("OFF\n0 0 0\n"), "a.off: has no vertices");
  EXPECT_EQ(errorOf("OFF BINARY\n", "a.off").kind(), ErrorKind::unsupported);
  EXPECT_EQ(errorOf("4OFF\n1 0 0\n0 0 0 1\n", "a.off").kind(), ErrorKind::unsupported);
}

} // namespace

} // namespace imgeo
