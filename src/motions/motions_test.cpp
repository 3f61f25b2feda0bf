#include "motions/motion.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

constexpr const char* names[] = {"cloth", "water", "turntable"};

/// The positions after `frames` frames.
std::vector<Vec3f> positionsOf(const char* name, std::uint32_t seed, int frames) {
  const auto motion = makeMotion(name, 32, seed);
  for (int i = 0; i < frames; ++i)
    motion->advance(1.0 / 30);
  return {motion->positions().begin(), motion->positions().end()};
}

TEST(Motion, HasTheSameFramesForTheSameSeed) {
  for (const char* name : names) {
    EXPECT_EQ(positionsOf(name, 1, 20), positionsOf(name, 1, 20)) << name;
    EXPECT_NE(positionsOf(name, 1, 20), positionsOf(name, 2, 20)) << name;
  }
}

TEST(Motion, StaysInItsBoxAndMoves) {
  for (const char* name : names) {
    const auto motion = makeMotion(name, 32, 7);
    std::vector<Vec3f> before(motion->positions().begin(), motion->positions().end());
    for (int frame = 0; frame < 150; ++frame) {
      motion->advance(1.0 / 30);
      std::size_t moved = 0;
      for (std::size_t i = 0; i < before.size(); ++i) {
        const Vec3f p = motion->positions()[i];
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_GE(p[axis], motion->box().min[axis]) << name << " frame " << frame;
          ASSERT_LE(p[axis], motion->box().max[axis]) << name << " frame " << frame;
        }
        moved += p == before[i] ? 0 : 1;
      }
      if (frame > 30) {
        EXPECT_GT(moved, before.size() / 4) << name << " frame " << frame;
      }
      before.assign(motion->positions().begin(), motion->positions().end());
    }
  }
}

TEST(Motion, OfClothStretchesNoEdgeMuch) {
  const auto cloth = makeCloth(32, 3);
  const float spacing = 2.0F / 31;
  for (int frame = 0; frame < 120; ++frame) {
    cloth->advance(1.0 / 30);
    for (std::uint32_t i = 0; i + 32 < 32 * 32; ++i)
      ASSERT_LT(length(cloth->positions()[i + 32] - cloth->positions()[i]), 1.5F * spacing) << "frame " << frame;
  }
}

/// The share of vertices at which the curvature along their row changes its sign from one vertex to the next, by more
/// than half a millimetre.
double shareOfStripes(const Motion& motion) {
  const std::uint32_t columns = motion.columns();
  std::size_t count = 0, stripes = 0;
  for (std::size_t i = columns; i + 3 < motion.positions().size(); ++i) {
    if (i % columns + 3 >= columns)
      continue;
    const auto* p = &motion.positions()[i];
    const Vec3f first = p[0] + p[2] - p[1] * 2, second = p[1] + p[3] - p[2] * 2;
    ++count;
    for (int axis = 0; axis < 3; ++axis)
      if (first[axis] * second[axis] < 0 && std::min(std::abs(first[axis]), std::abs(second[axis])) > 0.0005F) {
        ++stripes;
        break;
      }
  }
  return static_cast<double>(stripes) / static_cast<double>(count);
}

TEST(Motion, OfClothHasNoStripesOfTheWidthOfACell) {
  const auto cloth = makeCloth(48, 1);
  for (int frame = 1; frame <= 90; ++frame) {
    cloth->advance(1.0 / 30);
    if (frame % 15 == 0) {
      EXPECT_LT(shareOfStripes(*cloth), 0.05) << "frame " << frame;
    }
  }
}

TEST(Motion, OfAnUnknownNameIsNone) {
  EXPECT_EQ(makeMotion("dragon", 32, 1), nullptr);
}

} // namespace
} // namespace imgeo
