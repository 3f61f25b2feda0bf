#include "containers/unit_vectors.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

namespace imgeo {
namespace {

std::vector<Vec3f> directions() {
  std::vector<Vec3f> all;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x || y || z) {
          const Vec3f v{float(x), float(y), float(z)};
          all.push_back(v * (1 / length(v)));
        }
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 20000; ++i) {
    const Vec3f v{normal(random), normal(random), normal(random)};
    all.push_back(v * (1 / length(v)));
  }
  return all;
}

TEST(Octahedral, KeepsEveryDirectionWithinItsBound) {
  for (const std::uint32_t bits : {4u, 8u, 10u, 12u, 16u}) {
    double worst = 0;
    for (const Vec3f v : directions())
      worst = std::max(worst, angleBetween(v, unitFromOctahedral(octahedralFromUnit(v, bits), bits)));
    EXPECT_LE(worst, octahedralErrorBound(bits)) << bits << " bits";
    EXPECT_GE(worst, 0.9 * octahedralErrorBound(bits)) << "the bound is too loose, " << bits << " bits";
  }
}

TEST(Octahedral, KeepsTheAxesExactly) {
  for (const Vec3f axis :
       {Vec3f{1, 0, 0}, Vec3f{-1, 0, 0}, Vec3f{0, 1, 0}, Vec3f{0, -1, 0}, Vec3f{0, 0, 1}, Vec3f{0, 0, -1}})
    EXPECT_EQ(angleBetween(unitFromOctahedral(octahedralFromUnit(axis, 8), 8), axis), 0);
}

TEST(Octahedral, DecodesEveryCodeToADirectionThatItKeeps) {
  for (std::uint32_t x = 0; x <= 254; ++x)
    for (std::uint32_t y = 0; y <= 254; ++y) {
      const Vec3f v = unitFromOctahedral({x, y}, 8);
      const Vec3f again = unitFromOctahedral(octahedralFromUnit(v, 8), 8);
      EXPECT_LT(angleBetween(v, again), 1e-6);
    }
}

TEST(Octahedral, TakesTheNearestOfAllNeighbouringCodes) {
  for (const Vec3f v : directions()) {
    const auto code = octahedralFromUnit(v, 8);
    const double error = angleBetween(v, unitFromOctahedral(code, 8));
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto x = static_cast<std::int64_t>(code.x) + dx, y = static_cast<std::int64_t>(code.y) + dy;
        if (x < 0 || y < 0 || x > 254 || y > 254)
          continue;
        const Vec3f other = unitFromOctahedral({std::uint32_t(x), std::uint32_t(y)}, 8);
        EXPECT_LE(error, angleBetween(v, other) + 2e-3);
      }
  }
}

TEST(Spherical, KeepsEveryDirectionWithinItsBound) {
  for (const std::uint32_t bits : {8u, 16u}) {
    double worst = 0;
    for (const Vec3f v : directions())
      worst = std::max(worst, angleBetween(v, unitFromSpherical(sphericalFromUnit(v, bits), bits)));
    EXPECT_LE(worst, sphericalErrorBound(bits)) << bits << " bits";
    EXPECT_GE(worst, 0.5 * sphericalErrorBound(bits));
  }
}

TEST(ComponentErrorBound, HoldsForRgbNormals) {
  double worst = 0;
  for (const Vec3f v : directions()) {
    Vec3f back;
    for (int axis = 0; axis < 3; ++axis)
      back[axis] = std::round((v[axis] + 1) * 127.5f) / 127.5f - 1;
    worst = std::max(worst, angleBetween(v, back));
  }
  EXPECT_LE(worst, componentErrorBound(2.0 / 255));
  EXPECT_GE(worst, 0.5 * componentErrorBound(2.0 / 255));
}

} // namespace
} // namespace imgeo
