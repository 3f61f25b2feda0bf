#include "prepare/normals.h"

#include "base/parallel.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

constexpr NormalWeighting everyWeighting[] = {NormalWeighting::area, NormalWeighting::angle, NormalWeighting::uniform};

double degreesBetween(Vec3f a, Vec3f b) {
  return std::atan2(length(cross(Vec3d(a), Vec3d(b))), dot(Vec3d(a), Vec3d(b))) * 180 / std::numbers::pi;
}

/// The reference: each triangle adds its weighted unit normal to its three positions.
std::vector<Vec3d> scatteredNormals(const Mesh& mesh, NormalWeighting weighting) {
  std::vector<Vec3d> sums(mesh.positions.size());
  for (std::size_t first = 0; first < mesh.corners.size(); first += 3)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d a(mesh.cornerPosition(first + i)), b(mesh.cornerPosition(first + (i + 1) % 3)),
          c(mesh.cornerPosition(first + (i + 2) % 3));
      const Vec3d normal = cross(b - a, c - a);
      if (length(normal) == 0)
        continue;
      const double cosine = dot(b - a, c - a) / (length(b - a) * length(c - a));
      const double weight = weighting == NormalWeighting::area    ? length(normal) / 2
                            : weighting == NormalWeighting::angle ? std::acos(std::clamp(cosine, -1.0, 1.0))
                                                                  : 1;
      sums[mesh.wedgePositions[mesh.corners[first + i]]] += normal * (weight / length(normal));
    }
  return sums;
}

TEST(Normals, PointAlongTheRadiiOfASphere) {
  const Mesh sphere = testing::sphere(60, 120);
  for (const NormalWeighting weighting : everyWeighting) {
    Mesh mesh = sphere;
    computeNormals(mesh, weighting);
    for (std::size_t i = 0; i < mesh.wedgeCount(); ++i)
      ASSERT_LT(degreesBetween(mesh.normals[i], sphere.normals[i]), 1.5);
  }
}

TEST(Normals, AgreeWithTheReference) {
  for (std::uint32_t seed = 0; seed < 60; ++seed)
    for (const NormalWeighting weighting : everyWeighting) {
      Mesh mesh = testing::randomMesh(seed);
      if (mesh.topology != Topology::triangles)
        continue;
      const std::vector<Vec3d> expected = scatteredNormals(mesh, weighting);
      computeNormals(mesh, weighting);
      ASSERT_TRUE(isConsistent(mesh));
      for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
        ASSERT_NEAR(length(Vec3d(mesh.normals[wedge])), 1, 1e-6);
        const Vec3d sum = expected[mesh.wedgePositions[wedge]];
        double maxLength = 0;
        for (const Vec3d& s : expected)
          maxLength = std::max(maxLength, length(s));
        if (length(sum) < 1e-6 * maxLength)
          continue; // a sum near zero has no direction to compare
        ASSERT_LT(degreesBetween(mesh.normals[wedge], Vec3f(sum * (1 / length(sum)))), 1e-3) << seed;
      }
    }
}

TEST(Normals, AreUnitVectorsForTrianglesWithoutArea) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 9, 9}};
  testing::addPlainWedges(mesh);
  testing::addTriangle(mesh, 0, 1, 2);
  for (const NormalWeighting weighting : everyWeighting) {
    computeNormals(mesh, weighting);
    EXPECT_EQ(mesh.normals, std::vector<Vec3f>(4, {0, 0, 1}));
  }
}

TEST(Normals, AreExactForTheSmallestAndTheLargestTriangles) {
  for (const float scale : {std::numeric_limits<float>::denorm_min(), 1e-38f, 1e38f}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, scale, 0}, {0, 0, scale}};
    testing::addPlainWedges(mesh);
    testing::addTriangle(mesh, 0, 1, 2);
    for (const NormalWeighting weighting : everyWeighting) {
      computeNormals(mesh, weighting);
      EXPECT_EQ(mesh.normals, std::vector<Vec3f>(3, {1, 0, 0})) << scale;
    }
  }
}

TEST(Normals, DoNotDependOnThreads) {
  Mesh one = testing::torus(100, 100), many = one;
  limitThreads(1);
  computeNormals(one, NormalWeighting::angle);
  limitThreads(0);
  computeNormals(many, NormalWeighting::angle);
  EXPECT_EQ(one.normals, many.normals);
}

} // namespace
} // namespace imgeo
