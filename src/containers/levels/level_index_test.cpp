#include "containers/levels/level_index.h"

#include "base/error.h"
#include "containers/levels/level_samples.h"

#include <gtest/gtest.h>
#include <map>

namespace imgeo {
namespace {

TEST(LevelIndex, StatesErrorsNoMoreThanAnEighthOfAnOctaveTooLarge) {
  for (const double steps : {0.0, 0.5, 1.0, 1.01, 7.0, 34.0, 549.0, 1e6}) {
    const double stated = statedError(errorCodeFor(steps));
    EXPECT_GE(stated, steps);
    EXPECT_LE(stated, std::max(1.0, steps * std::exp2(1.0 / 8) * (1 + 1e-12))) << steps;
  }
}

TEST(LevelIndex, NestsErrorsAndSpheresAsStored) {
  const LevelIndex index = testing::levelIndexOf({1, 4, 16, 64}, 20, 1024, 9);
  for (const LevelGroup& group : index.groups)
    for (const std::uint32_t child : group.children) {
      EXPECT_LT(index.groups[child].errorCode, group.errorCode);
      EXPECT_TRUE(contains(group.sphere, index.groups[child].sphere));
    }
}

TEST(LevelIndex, HasSpheresThatContainTheStatedBoundsAndAreNoLargerThanRoundingNeeds) {
  for (const std::uint32_t bits : {8u, 16u, 21u}) {
    LevelIndex index;
    index.positionBits = bits;
    index.groups = {LevelGroup{}};
    const double unit = levelUnit(bits), extent = std::exp2(bits) - 1;
    const GroupBounds bounds{{extent / 3, extent / 5, extent}, extent / 7, 0};
    setBounds(index, std::span(&bounds, 1));
    const LevelSphere& sphere = index.groups[0].sphere;
    const double distance = length(Vec3d(sphere.center) * unit - bounds.center), radius = sphere.radius * 4 * unit;
    EXPECT_GE(radius, bounds.radius + distance);
    EXPECT_LT(radius, bounds.radius + 5 * unit);
  }
}

TEST(LevelIndex, HasSpheresOfGroupsAloneUnlessTheyAreToNest) {
  const LevelIndex nested = testing::levelIndexOf({1, 4, 15, 60}, 18, 30, 9),
                   own = testing::levelIndexOf({1, 4, 15, 60}, 18, 30, 9, false);
  for (std::size_t i = 0; i < own.groups.size(); ++i) {
    EXPECT_EQ(own.groups[i].sphere.center, nested.groups[i].sphere.center);
    EXPECT_LE(own.groups[i].sphere.radius, nested.groups[i].sphere.radius);
    EXPECT_EQ(own.groups[i].errorCode, nested.groups[i].errorCode);
  }
  EXPECT_LT(2 * own.groups[1].sphere.radius, nested.groups[1].sphere.radius);
}

TEST(LevelIndex, HasAnUnboundedSphereWhereCodesDoNotSuffice) {
  LevelIndex index;
  index.groups = {LevelGroup{}};
  const GroupBounds bounds{{0, 0, 0}, 300000, 0};
  setBounds(index, std::span(&bounds, 1));
  EXPECT_EQ(index.groups[0].sphere.radius, unboundedRadiusCode);
}

TEST(LevelIndex, NamesFilesOfGroupsAndPages) {
  EXPECT_EQ(groupUrl("geometry/a/levels.png", 0), "geometry/a/0/0.png");
  EXPECT_EQ(groupUrl("geometry/a/levels.png", 41234), "geometry/a/41/234.png");
  EXPECT_EQ(groupUrl("levels.png", 999), "0/999.png");
  EXPECT_EQ(levelPageUrl("geometry/a/levels.png", 0), "geometry/a/levels.png");
  EXPECT_EQ(levelPageUrl("geometry/a/levels.png", 12), "geometry/a/levels-12.png");
  EXPECT_EQ(levelPageUrl("geometry/a.b/levels", 1), "geometry/a.b/levels-1");
}

TEST(LevelIndex, RefusesAPageOfAnotherSizeThanStated) {
  const LevelIndex index = testing::levelIndexOf({1, 6}, 16, 4, 1);
  const std::vector<Bytes> files = writeLevelIndex(index);
  std::map<std::string, Bytes> byUrl{{"levels.png", files[0]}, {"levels-1.png", files[1]}};
  const auto fetch = [&](const std::string& url) { return byUrl.at(url); };
  EXPECT_EQ(readLevelIndex("levels.png", fetch), index);
  byUrl["levels-1.png"].push_back(0);
  try {
    readLevelIndex("levels.png", fetch);
    FAIL() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.location(), "levels-1.png");
  }
}

TEST(LevelIndex, TakesSomeTwelveBytesAGroup) {
  const LevelIndex index = testing::levelIndexOf({1, 4, 16, 64, 256}, 16, 1024, 3);
  const double bytes = static_cast<double>(writeLevelIndex(index)[0].size()) / static_cast<double>(index.groups.size());
  EXPECT_GT(bytes, 8);
  EXPECT_LT(bytes, 24) << "random sizes and centres";
}

} // namespace
} // namespace imgeo
