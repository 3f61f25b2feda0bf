#include "prepare/levels/poisson_disk.h"

#include "prepare/levels/nearest_point.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace imgeo {
namespace {

using testing::Random;

/// Points of a plane that is not parallel to an axis, denser on one side.
std::vector<Vec3u> slantedPlane(std::size_t count, std::uint32_t seed) {
  Random random(seed);
  std::vector<Vec3u> points;
  while (points.size() < count) {
    const std::uint32_t x = random.below(60000), y = random.below(60000);
    if (random.below(60000) < x + 6000)
      points.push_back({x, y, (x + y) / 3});
  }
  return points;
}

std::vector<Vec3u> pointsIn(const std::vector<Vec3u>& points, const std::vector<bool>& isKept) {
  std::vector<Vec3u> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (isKept[i])
      result.push_back(points[i]);
  return result;
}

std::vector<bool> chooseSome(const std::vector<Vec3u>& points, std::size_t maxKept) {
  return choosePoissonDisk(points, std::vector<std::uint32_t>(points.size()), maxKept);
}

/// The largest distance of one of the points from the nearest of some of them.
double largestDistance(const std::vector<Vec3u>& points, const std::vector<Vec3u>& some) {
  const NearestPoint nearest(some);
  double largest = 0;
  for (const Vec3u& point : points)
    largest = nearest.farther(largest, point);
  return largest;
}

/// The smallest distance between two of the points.
double smallestDistance(const std::vector<Vec3u>& points) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      smallest = std::min(smallest, length(Vec3d(points[i]) - Vec3d(points[j])));
  return smallest;
}

TEST(PoissonDisk, KeepsAboutAsManyPointsAsAllowedAndNoMore) {
  for (const std::size_t count : {100u, 1000u, 20000u})
    for (const std::size_t maxKept : {count / 4, count / 3}) {
      const std::vector<Vec3u> points = slantedPlane(count, 1);
      const std::size_t kept = pointsIn(points, chooseSome(points, maxKept)).size();
      EXPECT_LE(kept, maxKept);
      EXPECT_GE(static_cast<double>(kept), 0.9 * static_cast<double>(maxKept)) << count;
    }
}

TEST(PoissonDisk, KeepsPointsThatAreFartherApartThanTheOthersAreFromThem) {
  const std::vector<Vec3u> points = slantedPlane(8000, 2);
  const std::vector<bool> disk = chooseSome(points, 2000);
  EXPECT_GT(smallestDistance(pointsIn(points, disk)), largestDistance(points, pointsIn(points, disk)));
}

TEST(PoissonDisk, IsFarBetterThanChance) {
  const std::vector<Vec3u> points = slantedPlane(8000, 3);
  const std::vector<bool> disk = chooseSome(points, 2000);
  const std::vector<Vec3u> byChance(points.begin(), points.begin() + 2000);
  EXPECT_LT(2 * largestDistance(points, pointsIn(points, disk)), largestDistance(points, byChance));
}

TEST(NearestPoint, IsThatOfAllPoints) {
  const std::vector<Vec3u> points = slantedPlane(1000, 4), others = slantedPlane(200, 8);
  const NearestPoint nearest(points);
  double largest = 0, expectedLargest = 0;
  for (const Vec3u& other : others) {
    double expected = std::numeric_limits<double>::infinity();
    for (const Vec3u& point : points)
      expected = std::min(expected, length(Vec3d(point) - Vec3d(other)));
    EXPECT_DOUBLE_EQ(nearest.distanceOf(other), expected);
    largest = nearest.farther(largest, other);
    expectedLargest = std::max(expectedLargest, expected);
  }
  EXPECT_DOUBLE_EQ(largest, expectedLargest);
}

TEST(PoissonDisk, ChoosesTheSamePointsInAnyOrder) {
  std::vector<Vec3u> points = slantedPlane(2000, 5);
  std::vector<Vec3u> first = pointsIn(points, chooseSome(points, 500));
  std::ranges::reverse(points);
  std::vector<Vec3u> second = pointsIn(points, chooseSome(points, 500));
  std::ranges::reverse(second);
  EXPECT_EQ(first, second);
}

TEST(PoissonDisk, KeepsOneOfEqualPoints) {
  std::vector<Vec3u> points(100, Vec3u{5, 5, 5});
  points.push_back({9, 9, 9});
  const std::vector<bool> disk = chooseSome(points, 10);
  EXPECT_EQ(pointsIn(points, disk), (std::vector<Vec3u>{{5, 5, 5}, {9, 9, 9}}));
}

TEST(PoissonDisk, KeepsAllWhereThereAreNoMoreAndOneWhereOneIsAllowed) {
  const std::vector<Vec3u> points = slantedPlane(50, 6);
  EXPECT_EQ(pointsIn(points, chooseSome(points, 50)).size(), 50u);
  EXPECT_EQ(pointsIn(points, chooseSome(points, 1)).size(), 1u);
}

TEST(PoissonDisk, CoversEachPartByItsOwnPoints) {
  const std::vector<Vec3u> points = slantedPlane(6000, 7);
  std::vector<std::uint32_t> parts;
  for (const Vec3u& point : points)
    parts.push_back(point.x < 40000 ? 0 : 1);
  const std::vector<bool> isKept = choosePoissonDisk(points, parts, 1500);
  const double whole = largestDistance(points, pointsIn(points, isKept));
  for (const std::uint32_t part : {0u, 1u}) {
    std::vector<Vec3u> own, kept;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (parts[i] == part)
        own.push_back(points[i]);
      if (parts[i] == part && isKept[i])
        kept.push_back(points[i]);
    }
    EXPECT_LT(largestDistance(own, kept), 1.1 * whole);
  }
  EXPECT_LE(pointsIn(points, isKept).size(), 1500u);
  EXPECT_GE(pointsIn(points, isKept).size(), 1350u);
}

TEST(PoissonDisk, KeepsAPointOfEachPart) {
  std::vector<Vec3u> points = slantedPlane(1000, 7);
  std::vector<std::uint32_t> parts(points.size());
  points.push_back({points[0].x + 1, points[0].y, points[0].z});
  parts.push_back(1);
  EXPECT_TRUE(choosePoissonDisk(points, parts, 10).back());
}

TEST(PoissonDisk, TakesCloudsOnALineAndOfTheFullRange) {
  std::vector<Vec3u> line;
  for (std::uint32_t i = 0; i < 1000; ++i)
    line.push_back({16 * i * i, 0, (1u << 24) - 1});
  const std::size_t kept = pointsIn(line, chooseSome(line, 250)).size();
  EXPECT_LE(kept, 250u);
  EXPECT_GE(kept, 225u);
}

} // namespace
} // namespace imgeo
