#include "prepare/base_mesh.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo {
namespace {

using namespace testing;

struct Based {
  PatchedMesh patched;
  BaseMesh base;
};

Based basedOf(Mesh mesh, std::uint32_t maxWedges) {
  weld(mesh);
  Based based{cutIntoPatches(mesh, latticeFor(boxOf(mesh), 16), maxWedges), {}};
  based.base = baseOf(based.patched, 2).value();
  return based;
}

/// The distance of two points on a circle of length 1.
double around(double a, double b) {
  return std::abs(a - b - std::round(a - b));
}

/// The texture coordinate of a point of a torus.
Vec2<double> texCoordOf(Vec3d point) {
  const double radius = std::hypot(point.x, point.z) - 1;
  return {std::atan2(-point.z, point.x) / (2 * std::numbers::pi), std::atan2(point.y, radius) / (2 * std::numbers::pi)};
}

TEST(BaseWedges, KeepTextureCoordinatesAndStretchNoTriangleAcrossASeam) {
  for (const std::uint32_t maxWedges : {2000u, 65535u}) {
    const Based based = basedOf(torus(100, 100), maxWedges);
    const BaseMesh& base = based.base;
    ASSERT_EQ(base.texCoords.size(), base.wedgePositions.size());
    EXPECT_GT(base.wedgePositions.size(), base.positions.size());
    for (std::size_t wedge = 0; wedge < base.wedgePositions.size(); ++wedge) {
      const Vec2<double> expected = texCoordOf(based.patched.lattice.point(base.positions[base.wedgePositions[wedge]]));
      EXPECT_LT(around(base.texCoords[wedge].x, expected.x), 0.08) << wedge;
      EXPECT_LT(around(base.texCoords[wedge].y, expected.y), 0.08) << wedge;
    }
    for (std::size_t corner = 0; corner < base.corners.size(); ++corner) {
      const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
      const Vec2f a = base.texCoords[base.corners[corner]], b = base.texCoords[base.corners[next]];
      EXPECT_LT(std::abs(a.x - b.x), 0.4) << "triangle " << corner / 3;
      EXPECT_LT(std::abs(a.y - b.y), 0.4) << "triangle " << corner / 3;
    }
  }
}

TEST(BaseWedges, AreSeveralOnlyAtTextureSeams) {
  Mesh mesh = torus(100, 100);
  const Based seamed = basedOf(mesh, 65535);
  std::size_t split = 0;
  std::vector<std::uint32_t> wedges(seamed.base.positions.size());
  for (const std::uint32_t position : seamed.base.wedgePositions)
    split += ++wedges[position] == 2;
  EXPECT_LT(split, seamed.base.positions.size() / 3) << "the seams are two lines";
  mesh.texCoords.clear();
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
    mesh.colors.push_back({static_cast<std::uint8_t>(wedge % 251), 0, 0, 255});
  const Based colored = basedOf(mesh, 65535);
  EXPECT_EQ(colored.base.wedgePositions.size(), colored.base.positions.size());
  EXPECT_EQ(colored.base.colors.size(), colored.base.positions.size());
}

TEST(BaseWedges, TakeTheAttributesOfTheNearestWedge) {
  Mesh mesh = sphere(100, 100);
  NamedAttribute height{"height", 1, {}};
  for (const Vec3f& position : mesh.positions)
    height.values.push_back(position.y);
  mesh.namedAttributes = {height};
  const Based based = basedOf(mesh, 3000);
  ASSERT_EQ(based.base.namedAttributes.size(), 1u);
  for (std::size_t wedge = 0; wedge < based.base.wedgePositions.size(); ++wedge) {
    const Vec3d point = based.patched.lattice.point(based.base.positions[based.base.wedgePositions[wedge]]);
    EXPECT_NEAR(based.base.namedAttributes[0].values[wedge], point.y, 0.06);
  }
  EXPECT_TRUE(based.base.normals.empty());
}

} // namespace
} // namespace imgeo
