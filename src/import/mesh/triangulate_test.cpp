#include "import/mesh/triangulate.h"

#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace imgeo::testing {
namespace {

using Ring = std::vector<Vec3f>;

/// Twice the vector area of a polygon. The triangles of every triangulation have the same sum of vector areas; the sum
/// of their lengths is the same only where no triangle has the opposite orientation.
Vec3d twiceAreaOf(const Ring& ring) {
  Vec3d sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += cross(Vec3d(ring[i]) - Vec3d(ring[0]), Vec3d(ring[i + 1]) - Vec3d(ring[0]));
  return sum;
}

std::vector<std::uint32_t> cut(const Ring& ring) {
  std::vector<std::uint32_t> triangles;
  EXPECT_TRUE(triangulate(ring, triangles));
  EXPECT_EQ(triangles.size(), 3 * (ring.size() - 2));
  for (const std::uint32_t corner : triangles)
    EXPECT_LT(corner, ring.size());
  return triangles;
}

void expectCovered(const Ring& ring) {
  const std::vector<std::uint32_t> triangles = cut(ring);
  double summed = 0;
  for (std::size_t at = 0; at < triangles.size(); at += 3)
    summed += length(twiceAreaOf({ring[triangles[at]], ring[triangles[at + 1]], ring[triangles[at + 2]]}));
  EXPECT_NEAR(summed, length(twiceAreaOf(ring)), 1e-5 * length(twiceAreaOf(ring)));
}

/// A polygon around the origin whose radius changes from corner to corner, in a random plane: concave, without
/// crossings.
Ring starShaped(Random& random, std::size_t corners) {
  const Vec3d normal(random.direction());
  Vec3d u = cross(normal, Vec3d(random.direction()));
  u = u * (1 / length(u));
  const Vec3d v = cross(normal, u);
  Ring ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
    const double radius = random.between(0.2f, 1);
    ring.push_back(Vec3f((u * std::cos(angle) + v * std::sin(angle)) * radius));
  }
  return ring;
}

TEST(Triangulate, MakesAFanOfAConvexPolygon) {
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Triangulate, CoversAConcaveQuadFromEveryFirstCorner) {
  const Ring arrow{{0, 0, 0}, {4, 1, 0}, {0, 2, 0}, {1, 1, 0}};
  for (std::size_t first = 0; first < 4; ++first) {
    Ring ring = arrow;
    std::ranges::rotate(ring, ring.begin() + static_cast<std::ptrdiff_t>(first));
    expectCovered(ring);
    std::ranges::reverse(ring);
    expectCovered(ring);
  }
}

TEST(Triangulate, CoversConcavePolygonsInEveryPlane) {
  Random random(3);
  for (int i = 0; i < 500; ++i)
    expectCovered(starShaped(random, 4 + random.below(40)));
}

TEST(Triangulate, CoversAPolygonWithAHoleAndItsBridge) {
  expectCovered(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(Triangulate, KeepsTheCountForDegeneratePolygons) {
  cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}});              // crosses itself
  cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}); // a line
  cut(Ring(7, Vec3f{1, 2, 3}));                                   // a point
  Ring pentagram;
  for (int i = 0; i < 5; ++i)
    pentagram.push_back(Vec3f(Vec3d{std::cos(i * 0.8 * std::numbers::pi), std::sin(i * 0.8 * std::numbers::pi), 0}));
  cut(pentagram);
}

TEST(Triangulate, ReturnsFalseForATooLargeConcavePolygon) {
  Random random(4);
  std::vector<std::uint32_t> triangles;
  const Ring ring = starShaped(random, maxEarClippedCorners + 1);
  EXPECT_FALSE(triangulate(ring, triangles));
  EXPECT_EQ(triangles.size(), 3 * (ring.size() - 2));
}

} // namespace
} // namespace imgeo::testing
