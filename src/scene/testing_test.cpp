#include "scene/testing.h"

#include <gtest/gtest.h>
#include <map>
#include <utility>

namespace imgeo::testing {
namespace {

/// Directed edges between positions, each with the times it is used.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> directedEdges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t at = 0; at < mesh.corners.size(); at += 3)
    for (std::size_t k = 0; k < 3; ++k)
      ++edges[{mesh.wedgePositions[mesh.corners[at + k]], mesh.wedgePositions[mesh.corners[at + (k + 1) % 3]]}];
  return edges;
}

double signedVolume(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t at = 0; at < mesh.corners.size(); at += 3)
    volume += dot(Vec3d(mesh.cornerPosition(at)),
                  cross(Vec3d(mesh.cornerPosition(at + 1)), Vec3d(mesh.cornerPosition(at + 2)))) /
              6;
  return volume;
}

TEST(TestMeshes, SphereAndTorusAreClosedAndFaceOutwards) {
  for (const Mesh& mesh : {sphere(6, 9), torus(7, 5)}) {
    EXPECT_TRUE(isConsistent(mesh));
    EXPECT_GT(signedVolume(mesh), 0);
    const auto edges = directedEdges(mesh);
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
  }
}

TEST(TestMeshes, HaveTheStatedCounts) {
  EXPECT_EQ(sphere(6, 9).positions.size(), 2u + 5 * 9);
  EXPECT_EQ(sphere(6, 9).elementCount(), 2u * 5 * 9);
  EXPECT_EQ(torus(7, 5).positions.size(), 35u);
  EXPECT_EQ(torus(7, 5).wedgeCount(), 48u);
  EXPECT_EQ(torus(7, 5).elementCount(), 70u);
  EXPECT_EQ(grid(4).positions.size(), 25u);
  EXPECT_EQ(grid(4).elementCount(), 32u);
  EXPECT_EQ(soup(17, 1).elementCount(), 17u);
  EXPECT_EQ(pointCloud(17, 1).elementCount(), 17u);
}

TEST(TestMeshes, NonManifoldHasAnEdgeThatThreeTrianglesShare) {
  const Mesh mesh = nonManifold();
  EXPECT_TRUE(isConsistent(mesh));
  auto edges = directedEdges(mesh);
  EXPECT_EQ((edges[{0, 1}]), 2);
  EXPECT_EQ((edges[{1, 0}]), 1);
}

TEST(TestMeshes, RandomOnesAreConsistentFiniteAndRepeatable) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Mesh mesh = randomMesh(seed), again = randomMesh(seed);
    EXPECT_TRUE(isConsistent(mesh)) << "seed " << seed;
    EXPECT_GT(mesh.elementCount(), 0u) << "seed " << seed;
    EXPECT_EQ(mesh.positions, again.positions) << "seed " << seed;
    EXPECT_EQ(mesh.corners, again.corners) << "seed " << seed;
    for (const Vec3f& p : mesh.positions)
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << "seed " << seed;
    for (const Vec3f& n : mesh.normals)
      EXPECT_NEAR(length(Vec3d(n)), 1, 1e-6) << "seed " << seed;
  }
}

} // namespace
} // namespace imgeo::testing
