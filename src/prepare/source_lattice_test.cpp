#include "prepare/source_lattice.h"

#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// Positions on random points of a lattice, each moved by at most `error`, and those at both ends of its box.
std::vector<Vec3f> positionsOn(const Lattice& lattice, std::uint32_t steps, std::size_t count, double error,
                               std::uint32_t seed) {
  testing::Random random(seed);
  std::vector<Vec3f> positions{Vec3f(lattice.origin), Vec3f(lattice.point({steps, steps / 2, steps / 3}))};
  while (positions.size() < count) {
    Vec3d at = lattice.point({random.below(steps + 1), random.below(steps / 2 + 1), random.below(steps / 3 + 1)});
    for (int axis = 0; axis < 3; ++axis)
      at[axis] += error * random.between(-1, 1);
    positions.push_back(Vec3f(at));
  }
  return positions;
}

std::optional<SourceLattice> foundIn(const std::vector<Vec3f>& positions, std::uint32_t bits = 16) {
  Box3d box;
  for (const Vec3f& position : positions)
    box.add(Vec3d(position));
  return findSourceLattice(positions, latticeFor(box, bits));
}

/// Expects every position within the stated error of a point of the lattice.
void expectWithinError(const std::vector<Vec3f>& positions, const SourceLattice& found) {
  const std::vector<Vec3u> points = quantise(positions, found.lattice);
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_LE(std::abs(found.lattice.point(points[i])[axis] - double(positions[i][axis])), found.error * 1.0001);
}

TEST(SourceLattice, IsFoundInNumbersOfFewDecimals) {
  const std::vector<Vec3f> positions = positionsOn({{-1.028, 12.5, 0.003}, 0.001, 12}, 3000, 2000, 0, 1);
  const std::optional<SourceLattice> found = foundIn(positions);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->lattice.step, 0.001);
  EXPECT_EQ(found->lattice.bits, 12u);
  EXPECT_LT(found->error, 2e-6); // of single precision
  expectWithinError(positions, *found);
}

TEST(SourceLattice, IsFoundForEveryStepAndOrigin) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    const double step = std::exp(random.between(-5, 5));
    const std::uint32_t steps = 300 + random.below(30000);
    const Lattice lattice{{step * 1000 * random.between(0, 1), -step * 1000 * random.between(0, 1), 0}, step, 16};
    const std::vector<Vec3f> positions = positionsOn(lattice, steps, 2000 + random.below(20000), 1e-4 * step, seed);
    const std::optional<SourceLattice> found = foundIn(positions);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->lattice.step / step, 1, 1e-5);
    EXPECT_LE(found->error, 0.01 * step);
    expectWithinError(positions, *found);
  }
}

TEST(SourceLattice, IsNoneOfPositionsOnNoLattice) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    testing::Random random(seed);
    std::vector<Vec3f> positions;
    for (int i = 0; i < 3000; ++i)
      positions.push_back(random.point());
    EXPECT_FALSE(foundIn(positions)) << seed;
  }
}

TEST(SourceLattice, IsNoneIfItIsFinerThanRequested) {
  const std::vector<Vec3f> positions = positionsOn({{0, 0, 0}, 1, 16}, 60000, 5000, 0, 3);
  EXPECT_TRUE(foundIn(positions, 16));
  EXPECT_FALSE(foundIn(positions, 15));
}

TEST(SourceLattice, IsNoneIfOnePositionLiesBetweenItsPoints) {
  std::vector<Vec3f> positions = positionsOn({{0, 0, 0}, 0.5, 16}, 2000, 30001, 0, 4);
  ASSERT_TRUE(foundIn(positions));
  positions[12345].y += 0.25f; // not among those from which the step is estimated
  EXPECT_FALSE(foundIn(positions));
}

TEST(SourceLattice, IsNoneOfAFewPositions) {
  EXPECT_FALSE(foundIn(positionsOn({{0, 0, 0}, 0.5, 16}, 100, 255, 0, 5)));
}

TEST(SourceLattice, IsFoundInAFlatMesh) {
  std::vector<Vec3f> positions = positionsOn({{0, 0, 0}, 0.25, 16}, 900, 1000, 0, 6);
  for (Vec3f& position : positions)
    position.z = 7;
  const std::optional<SourceLattice> found = foundIn(positions);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->lattice.step, 0.25);
  expectWithinError(positions, *found);
}

} // namespace
} // namespace imgeo
