#include "prepare/levels/point_levels.h"

#include "base/parallel.h"
#include "prepare/levels/nearest_point.h"
#include "scene/testing.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::Random;

/// A cloud on a sphere with colours and a value, of which some points are at the same position.
Mesh numberedCloud(std::uint32_t count, std::uint32_t seed) {
  Random random(seed);
  Mesh mesh;
  mesh.topology = Topology::points;
  NamedAttribute number{"number", 1, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    mesh.positions.push_back(i > 0 && random.oneIn(50) ? mesh.positions.back() : random.direction());
    mesh.colors.push_back(random.color());
    number.values.push_back(static_cast<float>(i));
    mesh.corners.push_back(i);
  }
  testing::addPlainWedges(mesh);
  mesh.namedAttributes = {number};
  return mesh;
}

/// The groups in the order of `levels`.
struct BuiltCloud {
  Levels levels;
  std::vector<std::vector<Patch>> groups;
};

BuiltCloud buildCloud(const Mesh& mesh, std::uint32_t groupPoints,
                      std::uint32_t regionPoints = defaultRegionTriangles) {
  BuiltCloud built;
  const std::vector<Vec3u> points = quantise(mesh.positions, latticeFor(boxOf(mesh), 16));
  std::vector<std::vector<std::vector<Patch>>> byLevel;
  const PointGroupSink sink{[&](std::uint32_t level, std::size_t count) {
                              EXPECT_EQ(level, byLevel.size());
                              byLevel.emplace_back(count);
                            },
                            [&](std::uint32_t level, std::size_t group, std::vector<Patch> segments) {
                              byLevel[level][group] = std::move(segments);
                            }};
  built.levels = buildPointLevels(mesh, points, {.groupTriangles = groupPoints, .regionTriangles = regionPoints}, sink);
  for (auto level = byLevel.rbegin(); level != byLevel.rend(); ++level)
    std::ranges::move(*level, std::back_inserter(built.groups));
  EXPECT_EQ(built.groups.size(), built.levels.groups.size());
  return built;
}

std::size_t pointCountOf(const std::vector<Patch>& segments) {
  std::size_t size = 0;
  for (const Patch& segment : segments)
    size += segment.wedgeCount();
  return size;
}

/// By number: the position and colour of each point of some segments, which the value `number` names.
std::vector<std::array<float, 7>> sortedPointsOf(const std::vector<Patch>& segments) {
  std::vector<std::array<float, 7>> points;
  for (const Patch& segment : segments)
    for (std::size_t i = 0; i < segment.wedgeCount(); ++i) {
      const Vec3f at(segment.positions[segment.wedgePositions[i]]);
      const Rgba& color = segment.colors[i];
      points.push_back({segment.namedAttributes[0].values[i], at.x, at.y, at.z, color.r, color.g, color.b});
    }
  std::ranges::sort(points);
  return points;
}

/// One region, and several.
class PointLevelsInRegions : public ::testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Regions, PointLevelsInRegions, ::testing::Values(defaultRegionTriangles, 900u));

TEST_P(PointLevelsInRegions, HaveEveryPointOnceOnLevel0) {
  const Mesh mesh = numberedCloud(5000, 1);
  const BuiltCloud built = buildCloud(mesh, 300, GetParam());
  std::vector<Patch> all;
  for (std::size_t i = 0; i < built.groups.size(); ++i)
    if (built.levels.groups[i].level == 0) {
      EXPECT_EQ(built.groups[i].size(), 1u);
      all.push_back(built.groups[i][0]);
    }
  const auto points = sortedPointsOf(all);
  ASSERT_EQ(points.size(), mesh.wedgeCount());
  const std::vector<Vec3u> positions = quantise(mesh.positions, latticeFor(boxOf(mesh), 16));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3f at(positions[i]);
    const Rgba& color = mesh.colors[i];
    EXPECT_EQ(points[i], (std::array<float, 7>{static_cast<float>(i), at.x, at.y, at.z, color.r, color.g, color.b}));
  }
}

TEST_P(PointLevelsInRegions, HaveAboutAQuarterOfThePointsOnEachLevelInGroupsThatAreNotTooLarge) {
  for (const std::uint32_t count : {301u, 1200u, 1201u, 5000u, 20000u}) {
    const BuiltCloud built = buildCloud(numberedCloud(count, 2), 300, GetParam());
    std::vector<std::size_t> sizes(built.levels.groups.front().level + 1);
    for (std::size_t i = 0; i < built.groups.size(); ++i) {
      EXPECT_LE(pointCountOf(built.groups[i]), 300u);
      sizes[built.levels.groups[i].level] += pointCountOf(built.groups[i]);
    }
    EXPECT_EQ(built.levels.rootCount, 1u);
    EXPECT_EQ(sizes[0], count);
    for (std::size_t level = 1; level < sizes.size(); ++level) {
      const double ratio = static_cast<double>(sizes[level]) / static_cast<double>(sizes[level - 1]);
      EXPECT_LE(ratio, 0.25) << count;
      EXPECT_GE(ratio, 0.2) << count;
    }
  }
}

TEST_P(PointLevelsInRegions, AreATreeWhoseSegmentsArePointsOfTheChildren) {
  const BuiltCloud built = buildCloud(numberedCloud(5000, 3), 200, GetParam());
  std::vector<std::size_t> parents(built.groups.size());
  for (std::size_t i = 0; i < built.groups.size(); ++i) {
    const std::vector<std::uint32_t>& children = built.levels.groups[i].children;
    EXPECT_EQ(built.groups[i].size(), std::max<std::size_t>(children.size(), 1));
    EXPECT_LE(children.size(), 4u);
    EXPECT_EQ(children.empty(), built.levels.groups[i].level == 0);
    for (std::size_t segment = 0; segment < children.size(); ++segment) {
      ++parents[children[segment]];
      EXPECT_EQ(built.levels.groups[children[segment]].level + 1, built.levels.groups[i].level);
      const auto own = sortedPointsOf({built.groups[i][segment]}),
                 below = sortedPointsOf(built.groups[children[segment]]);
      EXPECT_FALSE(own.empty());
      EXPECT_TRUE(std::ranges::includes(below, own));
    }
  }
  EXPECT_EQ(parents[0], 0u);
  EXPECT_EQ(std::ranges::count(parents, 1u), static_cast<std::ptrdiff_t>(parents.size() - 1));
}

std::vector<Vec3u> positionsOfGroup(const std::vector<Patch>& segments) {
  std::vector<Vec3u> positions;
  for (const Patch& segment : segments)
    positions.insert(positions.end(), segment.positions.begin(), segment.positions.end());
  return positions;
}

/// The positions of the points of level 0 below a group.
std::vector<Vec3u> positionsBelow(const BuiltCloud& built, std::uint32_t group) {
  const std::vector<std::uint32_t>& children = built.levels.groups[group].children;
  std::vector<Vec3u> positions = children.empty() ? positionsOfGroup(built.groups[group]) : std::vector<Vec3u>{};
  for (const std::uint32_t child : children)
    std::ranges::copy(positionsBelow(built, child), std::back_inserter(positions));
  return positions;
}

TEST_P(PointLevelsInRegions, StateHowFarPointsOfLevel0AreFromTheCoarseForm) {
  const BuiltCloud built = buildCloud(numberedCloud(4000, 4), 250, GetParam());
  for (const LeveledGroup& parent : built.levels.groups) {
    const auto number = static_cast<std::size_t>(&parent - built.levels.groups.data());
    for (std::size_t segment = 0; segment < parent.children.size(); ++segment) {
      const std::uint32_t child = parent.children[segment];
      const NearestPoint nearest(positionsOfGroup({built.groups[number][segment]}));
      double distance = 0;
      for (const Vec3u& position : positionsBelow(built, child))
        distance = std::max(distance, nearest.distanceOf(position));
      EXPECT_DOUBLE_EQ(built.levels.groups[child].error, distance);
    }
  }
  EXPECT_EQ(built.levels.groups[0].error, 0);
}

TEST(PointLevels, HaveSpheresAroundTheirPoints) {
  const BuiltCloud built = buildCloud(numberedCloud(3000, 5), 250);
  for (std::size_t i = 0; i < built.groups.size(); ++i)
    for (const Vec3u& position : positionsOfGroup(built.groups[i]))
      EXPECT_LE(length(Vec3d(position) - built.levels.groups[i].center), built.levels.groups[i].radius * (1 + 1e-12));
}

TEST(PointLevels, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = numberedCloud(5000, 6);
  limitThreads(1);
  const BuiltCloud alone = buildCloud(mesh, 200);
  limitThreads(4);
  const BuiltCloud together = buildCloud(mesh, 200);
  limitThreads(0);
  ASSERT_EQ(alone.groups.size(), together.groups.size());
  for (std::size_t i = 0; i < alone.groups.size(); ++i) {
    EXPECT_EQ(sortedPointsOf(alone.groups[i]), sortedPointsOf(together.groups[i]));
    EXPECT_EQ(alone.levels.groups[i].error, together.levels.groups[i].error);
  }
}

TEST(PointLevels, OfASparseRegionHaveGroupsOfOneChild) {
  Mesh mesh = numberedCloud(4000, 8);
  for (std::size_t i = 1000; i < mesh.positions.size(); ++i) // three quarters at one position
    mesh.positions[i] = {1, 0, 0};
  const BuiltCloud built = buildCloud(mesh, 100, 500);
  EXPECT_EQ(built.levels.rootCount, 1u);
  std::size_t onlyChildren = 0;
  for (std::size_t i = 0; i < built.groups.size(); ++i) {
    onlyChildren += built.levels.groups[i].children.size() == 1;
    EXPECT_LE(pointCountOf(built.groups[i]), 100u);
  }
  EXPECT_GT(onlyChildren, 0u);
}

TEST(PointLevels, OfOnePointThatIsRepeatedHaveOneRoot) {
  Mesh mesh = numberedCloud(1000, 7);
  for (Vec3f& position : mesh.positions)
    position = {1, 2, 3};
  const BuiltCloud built = buildCloud(mesh, 100);
  EXPECT_EQ(built.levels.rootCount, 1u);
  for (const LeveledGroup& group : built.levels.groups)
    EXPECT_EQ(group.error, 0);
}

} // namespace
} // namespace imgeo
