#include "prepare/lattice.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(Lattice, MovesPositionsByNoMoreThanHalfAStep) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const Mesh mesh = testing::randomMesh(seed);
    const Box3d box = boxOf(mesh);
    for (const std::uint32_t bits : {8u, 11u, 16u, 24u, 32u}) {
      const Lattice lattice = latticeFor(box, bits);
      const std::vector<Vec3u> quantised = quantise(mesh.positions, lattice);
      // Allows for the rounding of double arithmetic, in units of the box's coordinates.
      const double rounding = 4e-16 * (length(box.min) + length(box.max));
      for (std::size_t i = 0; i < quantised.size(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_LE(quantised[i][axis], lattice.maximum());
          ASSERT_LE(std::abs(lattice.point(quantised[i])[axis] - static_cast<double>(mesh.positions[i][axis])),
                    lattice.step / 2 + rounding)
              << "seed " << seed << ", bits " << bits;
        }
    }
  }
}

TEST(Lattice, SpansTheLongestEdge) {
  Box3d box;
  box.add({-1, 2, 3});
  box.add({4, 3, 3});
  const Lattice lattice = latticeFor(box, 16);
  EXPECT_EQ(lattice.origin, box.min);
  EXPECT_EQ(lattice.step, 5.0 / 65535);
  const std::vector<Vec3f> corners{{-1, 2, 3}, {4, 3, 3}};
  EXPECT_EQ(quantise(corners, lattice), (std::vector<Vec3u>{{0, 0, 0}, {65535, 13107, 0}}));
}

TEST(Lattice, HasAStepEvenWithoutExtent) {
  Box3d point;
  point.add({7, 8, 9});
  EXPECT_EQ(latticeFor(point, 16).step, 1);
  EXPECT_EQ(latticeFor(point, 16).origin, (Vec3d{7, 8, 9}));
  EXPECT_EQ(quantise(std::vector<Vec3f>{{7, 8, 9}}, latticeFor(point, 8)), (std::vector<Vec3u>{{0, 0, 0}}));
  EXPECT_EQ(latticeFor(Box3d{}, 16).origin, Vec3d{});
}

TEST(Lattice, CoversTheWholeRangeOfFloats) {
  const float huge = std::numeric_limits<float>::max();
  const std::vector<Vec3f> positions{{-huge, 0, 0}, {huge, 0, huge}};
  Box3d box;
  for (const Vec3f& p : positions)
    box.add(Vec3d(p));
  for (const std::uint32_t bits : {8u, 32u}) {
    const Lattice lattice = latticeFor(box, bits);
    const std::vector<Vec3u> quantised = quantise(positions, lattice);
    EXPECT_EQ(quantised[0].x, 0u);
    EXPECT_EQ(quantised[1].x, lattice.maximum());
  }
}

} // namespace
} // namespace imgeo
