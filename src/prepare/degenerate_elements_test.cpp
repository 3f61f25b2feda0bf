#include "prepare/degenerate_elements.h"

#include "prepare/lattice.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

std::size_t collapsedCount(const Mesh& mesh, const Lattice& lattice) {
  return countCollapsedElements(mesh, quantise(mesh.positions, lattice), lattice.bits);
}

/// A triangle with these corners, and a triangle without area.
Mesh meshOf(Vec3f a, Vec3f b, Vec3f c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  testing::addPlainWedges(mesh);
  testing::addTriangle(mesh, 0, 1, 2);
  testing::addTriangle(mesh, 0, 1, 1);
  return mesh;
}

TEST(CollapsedElements, AreTrianglesWhoseCornersMoveOntoOnePointOrOneLine) {
  const Lattice unit{{0, 0, 0}, 1, 8};
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {9, 0, 0}, {0, 9, 0}), unit), 0u);
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {9, 0, 0}, {0.4f, 0.3f, 0}), unit), 1u);
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {9, 0, 0}, {4.9f, 0.3f, 0}), unit), 1u);
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {9, 0, 0}, {4, 0, 0}), unit), 0u)
      << "its area is 0 before it is quantised";
}

TEST(CollapsedElements, AreFoundOverTheFullRangeOfTheLattice) {
  const Lattice fine{{0, 0, 0}, 1.0 / 4294967295.0, 32};
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {1, 1, 1}, {1, 1, 0.99999994f}), fine), 0u);
  EXPECT_EQ(collapsedCount(meshOf({0, 0, 0}, {1, 0, 0}, {0.5f, 1e-11f, 0}), fine), 1u);
}

TEST(CollapsedElements, AreLinesThatLoseTheirLength) {
  Mesh mesh;
  mesh.topology = Topology::lines;
  mesh.positions = {{0, 0, 0}, {0.2f, 0, 0}, {1, 0, 0}};
  testing::addPlainWedges(mesh);
  mesh.corners = {0, 1, 1, 2, 0, 0};
  EXPECT_EQ(collapsedCount(mesh, {{0, 0, 0}, 1, 8}), 1u);
}

TEST(CollapsedElements, BecomeFewerWithEveryBit) {
  const Mesh mesh = testing::sphere(200, 200);
  std::size_t before = mesh.elementCount();
  for (const std::uint32_t bits : {8u, 10u, 12u, 16u}) {
    const std::size_t collapsed = collapsedCount(mesh, latticeFor(boxOf(mesh), bits));
    EXPECT_LE(collapsed, before) << bits;
    before = collapsed;
  }
  EXPECT_GT(collapsedCount(mesh, latticeFor(boxOf(mesh), 8)), 0u);
}

} // namespace
} // namespace imgeo
