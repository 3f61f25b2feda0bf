#include "prepare/levels/point_tree.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace imgeo {
namespace {

TEST(PointTree, HasTwoToFourChildrenOfEachGroup) {
  for (std::uint64_t count = 1; count < 700; ++count) {
    const ChildCounts counts = pointTreeAbove(count);
    ASSERT_EQ(counts.size(), pointTreeHeight(count)) << count;
    std::uint64_t below = count;
    for (const std::vector<std::uint32_t>& ofLevel : counts) {
      EXPECT_EQ(std::accumulate(ofLevel.begin(), ofLevel.end(), std::uint64_t{0}), below) << count;
      EXPECT_GE(*std::ranges::min_element(ofLevel), 2u) << count;
      EXPECT_LE(*std::ranges::max_element(ofLevel), 4u) << count;
      below = ofLevel.size();
    }
    EXPECT_EQ(below, 1u);
  }
}

TEST(PointTree, IsAsHighAsItsGroupsNeed) {
  EXPECT_EQ(pointTreeHeight(1), 0u);
  EXPECT_EQ(pointTreeHeight(2), 1u);
  EXPECT_EQ(pointTreeHeight(4), 1u);
  EXPECT_EQ(pointTreeHeight(5), 2u);
  EXPECT_EQ(pointTreeHeight(65), 4u);
  EXPECT_EQ(pointTreeCapacity(3), 64u);
  EXPECT_EQ(pointGroupCount(1000, 300), 4u);
}

} // namespace
} // namespace imgeo
