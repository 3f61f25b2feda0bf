#include "import/testing.h"

#include "import/mesh/point_cloud_testing.h"

#include <gtest/gtest.h>
#include <string>

namespace imgeo {

namespace {

using testing::errorOf;
using testing::keepingAll;
using testing::onlyMesh;
using testing::refusalOf;

TEST(Pts, PointsHaveTheirPositionsIntensitiesAndColours) {
  const Mesh mesh = onlyMesh("2\r\n1.5 2 -3 -1024 255 0 51\r\n0 0 0 2047 0 255 0\r\n", "a.pts", keepingAll());
  EXPECT_EQ(mesh.topology, Topology::points);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{1.5, 2, -3}, {0, 0, 0}}));
  EXPECT_EQ(mesh.colors[0], Rgba(Rgba8{255, 0, 51, 255}));
  ASSERT_EQ(mesh.namedAttributes.size(), 1u);
  EXPECT_EQ(mesh.namedAttributes[0].name, "intensity");
  EXPECT_EQ(mesh.namedAttributes[0].values, (std::vector<float>{-1024, 2047}));
}

TEST(Pts, LinesMayEndWithCarriageReturnsAlone) {
  EXPECT_EQ(onlyMesh("2\r1.5 2 -3\r0 0 0\r", "a.pts").positions, (std::vector<Vec3f>{{1.5, 2, -3}, {0, 0, 0}}));
}

TEST(Pts, LinesMayLackIntensitiesColoursOrBoth) {
  EXPECT_TRUE(onlyMesh("1\n1 2 3\n", "a.pts").colors.empty());
  EXPECT_EQ(onlyMesh("1\n1 2 3 0.5", "a.pts", keepingAll()).namedAttributes[0].values, std::vector<float>{0.5});
  EXPECT_EQ(onlyMesh("1\n1 2 3 255 255 255\n", "a.pts").colors[0], Rgba(1, 1, 1, 1));
  const Imported imported = importBytes(asBytes("1\n1 2 3 7\n"), "a.pts");
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"Not carried over from the PTS file: intensity."});
  EXPECT_EQ(imported.attributes, std::vector<std::string>{"intensity"});
}

TEST(Pts, EachScanIsAShape) {
  const Imported imported = importBytes(asBytes("1\n1 2 3\n0\n2\n4 5 6 1 2 3\n7 8 9 1 2 3\n"), "b.pts");
  ASSERT_EQ(imported.scene.meshes.size(), 2u);
  EXPECT_EQ(imported.scene.meshes[1].positions.size(), 2u);
  EXPECT_EQ(imported.scene.graph.nodes[imported.scene.graph.roots[1]].name, "b-3");
}

TEST(Pts, CoordinatesFarFromZeroAreStoredAroundAnOrigin) {
  const Imported imported = importBytes(asBytes("2\n500000.001 5800000.25 100\n500002.002 5800001.5 101\n"), "b.pts");
  const std::vector<Vec3f>& positions = imported.scene.meshes[0].positions;
  EXPECT_NEAR(positions[1].x - positions[0].x, 2.001, 1e-6);
  EXPECT_EQ(positions[0].y, 0.25f);
  EXPECT_EQ(positions[0].z, 0); // 100 is far, too, from a cloud of two metres
  const auto stated = [&](const Node& node) {
    return !node.fields.empty() && node.fields.back().value == "500001 5800000 100";
  };
  EXPECT_TRUE(std::ranges::any_of(imported.scene.graph.nodes, stated));
}

TEST(Pts, DamageIsRefusedWithItsLine) {
  const auto refused = [](std::string_view text) { return refusalOf(text, "a.pts"); };
  EXPECT_EQ(refused("3\n1 2 3\n1 2 3\n"), "a.pts:1: a scan of 3 points is promised, but only 13 bytes follow");
  EXPECT_EQ(refused("2\n1.00 2.00 3.00\n"), "a.pts:3: the file ends after 1 of a scan's 2 points");
  EXPECT_EQ(refused("2\n1 2 3\n1 2 3 4\n"), "a.pts:3: a point has 4 numbers, and those before have 3");
  EXPECT_EQ(refused("1\n1 2 3 4 5\n"), "a.pts:2: a point has 5 numbers, and not 3, 4, 6 or 7");
  EXPECT_EQ(refused("1\n1 2 3 4 5 6 7 8\n"), "a.pts:2: a point has more than seven numbers");
  EXPECT_EQ(refused("1\n1 2 nan\n"), "a.pts:2: a coordinate is not a number or beyond single precision");
  EXPECT_EQ(refused("-1\n1 2 3\n"), "a.pts:1: a scan has a negative number of points");
  EXPECT_EQ(refused("1 2\n1 2 3\n"), "a.pts:1: the line before a scan's points has more than their number");
  EXPECT_EQ(refused("0\n"), "a.pts: has no points");
  EXPECT_EQ(errorOf("99999999999\n1 2 3\n", "a.pts").kind(), ErrorKind::truncated);
}

} // namespace

} // namespace imgeo
