#include "prepare/base_mesh.h"

#include "prepare/base_mesh_testing.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <gtest/gtest.h>
#include <set>

namespace imgeo {
namespace {

using namespace testing;

PatchedMesh patchedOf(Mesh mesh, std::uint32_t maxWedges, std::uint32_t bits = 16) {
  weld(mesh);
  return cutIntoPatches(mesh, latticeFor(boxOf(mesh), bits), maxWedges);
}

/// A closed, bumpy mesh of 20,000 triangles.
Mesh bumpyTorus() {
  Mesh mesh = torus(100, 100);
  Random random(1);
  for (Vec3f& position : mesh.positions)
    position += random.point() * 0.004f;
  return mesh;
}

std::vector<PatchTriangles> trianglesOf(const PatchedMesh& mesh) {
  std::vector<PatchTriangles> triangles;
  for (const Patch& patch : mesh.patches)
    triangles.push_back(imgeo::trianglesOf(patch));
  return triangles;
}

TEST(BaseMesh, HasNoCracksInAnyMixtureWithPatches) {
  const Mesh meshes[] = {sphere(90, 90), bumpyTorus()};
  for (const Mesh& mesh : meshes)
    for (const std::uint32_t maxWedges : {1200u, 4000u, 65535u}) {
      const PatchedMesh patched = patchedOf(mesh, maxWedges);
      const std::optional<BaseMesh> base = baseOf(patched, 2);
      ASSERT_TRUE(base);
      EXPECT_EQ(base->segmentCount, patched.patches.size());
      EXPECT_TRUE(meetsAtBorders(*base, trianglesOf(patched)));
      expectClosedMixtures(*base, trianglesOf(patched));
    }
}

TEST(BaseMesh, KeepsBordersBetweenPatchesButNotTheBorderOfTheMesh) {
  const PatchedMesh patched = patchedOf(grid(100), 1500);
  ASSERT_GT(patched.patches.size(), 5u);
  const std::optional<BaseMesh> base = baseOf(patched, 2);
  ASSERT_TRUE(base);
  EXPECT_TRUE(meetsAtBorders(*base, trianglesOf(patched)));

  std::size_t borderVertexCount = 0;
  for (const Vec3u& position : base->positions)
    borderVertexCount += position.x == 0;
  EXPECT_LT(borderVertexCount, 40u) << "the grid's border is straight and needs few of its 101 vertices";
}

/// The positions and triangles of `mesh`; every other triangle has copies of the positions, which differ from these but
/// are at the same points of a lattice.
Mesh withTwins(const Mesh& mesh, std::uint32_t bits) {
  Mesh twins;
  twins.positions = mesh.positions;
  for (const Vec3f& position : mesh.positions)
    twins.positions.push_back(position * (1 - 1e-6f));
  const std::vector<Vec3u> points = quantise(twins.positions, latticeFor(boxOf(mesh), bits));
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t position = 0; position < 2 * count; ++position)
    twins.wedgePositions.push_back(points[position] == points[position % count] ? position : position % count);
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    twins.corners.push_back(mesh.wedgePositions[mesh.corners[corner]] + (corner / 3 % 2 == 0 ? 0 : count));
  return twins;
}

TEST(BaseMesh, HasNoCracksWherePositionsOfTheSourceShareALatticePoint) {
  for (const std::uint32_t maxWedges : {1200u, 65535u}) {
    const PatchedMesh patched = patchedOf(withTwins(sphere(90, 90), 12), maxWedges, 12);
    const std::optional<BaseMesh> base = baseOf(patched, 2);
    ASSERT_TRUE(base);
    EXPECT_TRUE(meetsAtBorders(*base, trianglesOf(patched)));
    expectClosedMixtures(*base, trianglesOf(patched));
  }
}

TEST(BaseMesh, DoesNotMeetPatchesWhenABorderVertexMoves) {
  const PatchedMesh patched = patchedOf(sphere(90, 90), 1500);
  const BaseMesh base = baseOf(patched, 2).value();
  std::vector<std::set<std::uint32_t>> segmentsOf(base.positions.size());
  for (std::size_t corner = 0; corner < base.corners.size(); ++corner)
    segmentsOf[base.corners[corner]].insert(base.segments[corner / 3]);
  const auto isShared = [](const std::set<std::uint32_t>& segments) { return segments.size() > 1; };
  const auto meetsAfterMoving = [&](auto found) {
    BaseMesh changed = base;
    changed.positions[static_cast<std::size_t>(found - segmentsOf.begin())].z += 1;
    return meetsAtBorders(changed, trianglesOf(patched));
  };
  EXPECT_FALSE(meetsAfterMoving(std::ranges::find_if(segmentsOf, isShared)));
  EXPECT_TRUE(meetsAfterMoving(std::ranges::find_if_not(segmentsOf, isShared)));
}

TEST(BaseMesh, HasTheRequestedNumberOfTriangles) {
  const PatchedMesh patched = patchedOf(bumpyTorus(), 65535);
  for (const double percent : {1.0, 2.0, 10.0}) {
    const std::optional<BaseMesh> base = baseOf(patched, percent);
    ASSERT_TRUE(base);
    EXPECT_NEAR(static_cast<double>(base->triangleCount()), 200 * percent, 20) << percent;
  }
}

TEST(BaseMesh, IsCloseToTheMesh) {
  const PatchedMesh patched = patchedOf(sphere(100, 100), 65535, 12);
  const std::optional<BaseMesh> base = baseOf(patched, 2);
  ASSERT_TRUE(base);
  const double radius = patched.lattice.maximum() / 2.0;
  for (const Vec3u& position : base->positions)
    EXPECT_NEAR(length(Vec3d(position) - Vec3d{radius, radius, radius}), radius, 0.02 * radius);
}

TEST(BaseMesh, KeepsColors) {
  Mesh mesh = sphere(90, 90);
  for (const Vec3f& position : mesh.positions)
    mesh.colors.push_back(position.y > 0 ? Rgba8{255, 0, 0, 255} : Rgba8{0, 0, 255, 255});
  const PatchedMesh patched = patchedOf(mesh, 3000);
  const std::optional<BaseMesh> base = baseOf(patched, 2);
  ASSERT_TRUE(base);
  ASSERT_EQ(base->colors.size(), base->positions.size());
  const double middle = patched.lattice.maximum() / 2.0;
  for (std::size_t i = 0; i < base->positions.size(); ++i) {
    const double height = base->positions[i].y - middle;
    if (std::abs(height) > 0.2 * middle) {
      EXPECT_EQ(base->colors[i].r, height > 0 ? 1 : 0);
    }
  }
}

TEST(BaseMesh, IsLeftOutIfItIsNotWorthItsBytes) {
  const auto hasBase = [](const Mesh& mesh, std::uint32_t maxWedges, double percent) {
    return baseOf(patchedOf(mesh, maxWedges), percent).has_value();
  };
  EXPECT_TRUE(hasBase(sphere(90, 90), 65535, 2));
  EXPECT_FALSE(hasBase(sphere(90, 90), 65535, 0));
  EXPECT_FALSE(hasBase(sphere(50, 50), 65535, 2)) << "a small mesh";
  EXPECT_FALSE(hasBase(sphere(90, 90), 20, 2)) << "nearly all vertices on borders";
  EXPECT_FALSE(hasBase(soup(20000, 1), 65535, 2)) << "triangles that share nothing";
  EXPECT_FALSE(hasBase(pointCloud(20000, 1), 65535, 2));
}

} // namespace
} // namespace imgeo
