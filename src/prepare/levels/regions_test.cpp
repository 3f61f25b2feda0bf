#include "prepare/levels/regions.h"

#include "scene/testing.h"

#include <gtest/gtest.h>
#include <limits>

namespace imgeo {
namespace {

TEST(SampledTriangle, IsOneOfEachOfAsManyEqualRanges) {
  EXPECT_EQ(sampledElementCount(1000), 1000u);
  for (std::uint64_t i = 0; i < 1000; ++i)
    EXPECT_EQ(sampledElement(i, 1000), i);
  const std::uint64_t count = 1'000'000'007, samples = sampledElementCount(count);
  ASSERT_EQ(samples, 1u << 18);
  std::uint64_t before = 0, odd = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const std::uint64_t number = sampledElement(i, count);
    ASSERT_GE(number, i * count / samples);
    ASSERT_LT(number, (i + 1) * count / samples);
    ASSERT_TRUE(i == 0 || number > before);
    before = number;
    odd += number % 2;
  }
  EXPECT_NEAR(static_cast<double>(odd), static_cast<double>(samples) / 2, 2000); // rows of files do not repeat in it
}

std::vector<FrameKey> randomKeys(std::size_t count) {
  testing::Random random(1);
  std::vector<FrameKey> keys;
  for (std::size_t i = 0; i < count; ++i)
    keys.push_back({random.below(1 << 20), random.below(1 << 12), random.oneIn(3) ? 5 : random.below(1 << 20)});
  return keys;
}

TEST(RegionTree, HasRegionsOfAboutAsManyTriangles) {
  const std::vector<FrameKey> keys = randomKeys(50000);
  for (const std::uint32_t regionTriangles : {700u, 4096u, 49999u, 50000u}) {
    const RegionTree tree(keys, keys.size(), regionTriangles);
    std::vector<std::uint32_t> counts(tree.regionCount());
    for (const FrameKey& key : keys)
      ++counts.at(tree.regionOf(key));
    const std::size_t fewest = (keys.size() + regionTriangles - 1) / regionTriangles;
    EXPECT_GE(counts.size(), fewest);
    EXPECT_LE(counts.size(), fewest + fewest / 4);
    for (const std::uint32_t count : counts) {
      EXPECT_GT(count, 0u);
      EXPECT_LE(count, regionTriangles);
    }
  }
}

TEST(RegionTree, IsOneRegionWhereAllKeysAreEqual) {
  const RegionTree tree(std::vector<FrameKey>(1000, FrameKey{3, 4, 5}), 1000, 100);
  EXPECT_EQ(tree.regionCount(), 1u);
  EXPECT_EQ(tree.regionOf({3, 4, 5}), 0u);
  EXPECT_EQ(RegionTree().regionOf({std::numeric_limits<std::int64_t>::max(), 0, -7}), 0u);
}

} // namespace
} // namespace imgeo
