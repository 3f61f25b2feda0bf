#include "prepare/base_mesh.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

using namespace testing;

struct MeshWithBase {
  PatchedMesh patched;
  BaseMesh base;
};

MeshWithBase withBase(Mesh mesh, std::uint32_t maxWedges) {
  weld(mesh);
  MeshWithBase meshWithBase{cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), maxWedges), {}};
  meshWithBase.base = baseOf(meshWithBase.patched, 2).value();
  return meshWithBase;
}

/// The distance of two points on a circle of length 1.
double circularDistance(double a, double b) {
  return std::abs(a - b - std::round(a - b));
}

/// The texture coordinate of a point of a torus.
Vec2<double> texCoordOf(Vec3d point) {
  const double radius = std::hypot(point.x, point.z) - 1;
  return {std::atan2(-point.z, point.x) / (2 * std::numbers::pi), std::atan2(point.y, radius) / (2 * std::numbers::pi)};
}

TEST(BaseWedges, KeepTextureCoordinatesAndStretchNoTriangleAcrossASeam) {
  for (const std::uint32_t maxWedges : {2000u, 65535u}) {
    const MeshWithBase meshWithBase = withBase(torus(100, 100), maxWedges);
    const BaseMesh& base = meshWithBase.base;
    ASSERT_EQ(base.texCoords.size(), base.wedgePositions.size());
    EXPECT_GT(base.wedgePositions.size(), base.positions.size());
    for (std::size_t wedge = 0; wedge < base.wedgePositions.size(); ++wedge) {
      const Vec2<double> expected =
          texCoordOf(meshWithBase.patched.lattice.point(base.positions[base.wedgePositions[wedge]]));
      EXPECT_LT(circularDistance(base.texCoords[wedge].x, expected.x), 0.08) << wedge;
      EXPECT_LT(circularDistance(base.texCoords[wedge].y, expected.y), 0.08) << wedge;
    }
    for (std::size_t corner = 0; corner < base.corners.size(); ++corner) {
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      const Vec2f a = base.texCoords[base.corners[corner]], b = base.texCoords[base.corners[next]];
      EXPECT_LT(std::abs(a.x - b.x), 0.4) << "triangle " << corner / 3;
      EXPECT_LT(std::abs(a.y - b.y), 0.4) << "triangle " << corner / 3;
    }
  }
}

TEST(BaseWedges, SplitPositionsOnlyAtTextureSeams) {
  Mesh mesh = torus(100, 100);
  const MeshWithBase seamed = withBase(mesh, 65535);
  std::size_t splitPositionCount = 0;
  std::vector<std::uint32_t> wedges(seamed.base.positions.size());
  for (const std::uint32_t position : seamed.base.wedgePositions)
    splitPositionCount += ++wedges[position] == 2;
  EXPECT_LT(splitPositionCount, seamed.base.positions.size() / 3) << "the seams are two lines";
  mesh.texCoords.clear();
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.colors.push_back(Rgba8{static_cast<std::uint8_t>(wedge % 251), 0, 0, 255});
  const MeshWithBase colored = withBase(mesh, 65535);
  EXPECT_EQ(colored.base.wedgePositions.size(), colored.base.positions.size());
  EXPECT_EQ(colored.base.colors.size(), colored.base.positions.size());
}

TEST(BaseWedges, TakeTheAttributesOfTheNearestWedge) {
  Mesh mesh = sphere(100, 100);
  NamedAttribute height{"height", 1, {}};
  for (const Vec3f& position : mesh.positions)
    height.values.push_back(position.y);
  mesh.namedAttributes = {height};
  const MeshWithBase meshWithBase = withBase(mesh, 3000);
  ASSERT_EQ(meshWithBase.base.namedAttributes.size(), 1u);
  for (std::size_t wedge = 0; wedge < meshWithBase.base.wedgePositions.size(); ++wedge) {
    const Vec3d point =
        meshWithBase.patched.lattice.point(meshWithBase.base.positions[meshWithBase.base.wedgePositions[wedge]]);
    EXPECT_NEAR(meshWithBase.base.namedAttributes[0].values[wedge], point.y, 0.06);
  }
  EXPECT_TRUE(meshWithBase.base.normals.empty());
}

} // namespace
} // namespace imgeo
