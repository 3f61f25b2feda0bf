#include "containers/normal_palette.h"

#include "base/parallel.h"
#include "containers/unit_vectors.h"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace imgeo {
namespace {

std::vector<Vec3f> randomNormals(std::size_t count, Vec3f stretch) {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  std::vector<Vec3f> normals;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3f v{normal(random) * stretch.x, normal(random) * stretch.y, normal(random) * stretch.z};
    normals.push_back(v * (1 / length(v)));
  }
  return normals;
}

Vec3f directionOf(Rgba8 color) {
  const Vec3f v{color.r / 127.5f - 1, color.g / 127.5f - 1, color.b / 127.5f - 1};
  return v * (1 / length(v));
}

double meanErrorDegrees(const std::vector<Vec3f>& normals, const NormalPalette& palette) {
  double sum = 0;
  for (std::size_t i = 0; i < normals.size(); ++i)
    sum += angleBetween(normals[i], directionOf(palette.colors[palette.indices[i]]));
  return sum / static_cast<double>(normals.size()) * 180 / std::numbers::pi;
}

TEST(NormalPalette, CoversEvenlyDistributedNormals) {
  const std::vector<Vec3f> normals = randomNormals(20000, {1, 1, 1});
  // A disc of 1/256 of the sphere has a radius of 7.2 degrees; the mean distance of its points from the centre is 2/3
  // of that.
  EXPECT_LT(meanErrorDegrees(normals, normalPalette(normals)), 5.2);
}

TEST(NormalPalette, AdaptsToTheDistributionOfNormals) {
  const std::vector<Vec3f> even = randomNormals(20000, {1, 1, 1}), flat = randomNormals(20000, {1, 1, 0.05f});
  EXPECT_LT(meanErrorDegrees(flat, normalPalette(flat)), 0.6 * meanErrorDegrees(even, normalPalette(even)));
}

TEST(NormalPalette, HasOnlyRoundingErrorsForFewDirections) {
  const std::vector<Vec3f> few = randomNormals(200, {1, 1, 1});
  std::vector<Vec3f> normals;
  for (int copy = 0; copy < 5; ++copy)
    normals.insert(normals.end(), few.begin(), few.end());
  EXPECT_LT(meanErrorDegrees(normals, normalPalette(normals)), 0.4);
}

TEST(NormalPalette, TakesTheNearestEntryForEveryNormal) {
  const std::vector<Vec3f> normals = randomNormals(3000, {1, 0.3f, 1});
  const NormalPalette palette = normalPalette(normals);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    double nearest = 10;
    for (const Rgba8 color : palette.colors)
      nearest = std::min(nearest, angleBetween(normals[i], directionOf(color)));
    EXPECT_LT(angleBetween(normals[i], directionOf(palette.colors[palette.indices[i]])), nearest + 0.01);
  }
}

TEST(NormalPalette, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<Vec3f> normals = randomNormals(5000, {1, 1, 0.2f});
  limitThreads(1);
  const NormalPalette alone = normalPalette(normals);
  limitThreads(0);
  const NormalPalette together = normalPalette(normals);
  EXPECT_EQ(alone.colors, together.colors);
  EXPECT_EQ(alone.indices, together.indices);
}

TEST(NormalPalette, OfNoNormalsHasNoIndices) {
  EXPECT_TRUE(normalPalette({}).indices.empty());
}

} // namespace
} // namespace imgeo
