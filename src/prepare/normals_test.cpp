#include "prepare/normals.h"

#include "base/parallel.h"
#include "prepare/boxes_testing.h"
#include "prepare/weld.h"
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

Vec3d facetNormal(const Mesh& mesh, std::size_t first) {
  const Vec3d a(mesh.cornerPosition(first)), b(mesh.cornerPosition(first + 1)), c(mesh.cornerPosition(first + 2));
  return cross(b - a, c - a);
}

TEST(Normals, OfABoxAreThoseOfItsSidesWhereItsEdgesAreCreases) {
  for (const NormalWeighting weighting : everyWeighting) {
    Mesh mesh = testing::boxes(1);
    mesh.creaseDegrees = 89;
    computeNormals(mesh, weighting);
    EXPECT_EQ(mesh.positions.size(), 8u);
    EXPECT_EQ(mesh.wedgeCount(), 24u);
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
      EXPECT_LT(degreesBetween(mesh.normals[mesh.corners[corner]], Vec3f(facetNormal(mesh, corner - corner % 3))),
                1e-3);
  }
}

TEST(Normals, AreSmoothAtEdgesOfTheCreaseAngleItself) {
  Mesh sharp = testing::boxes(1), smooth = testing::boxes(1);
  sharp.creaseDegrees = 90;
  computeNormals(sharp, NormalWeighting::angle);
  computeNormals(smooth, NormalWeighting::angle);
  EXPECT_EQ(sharp.wedgeCount(), 8u);
  for (std::size_t corner = 0; corner < sharp.corners.size(); ++corner)
    EXPECT_EQ(sharp.normals[sharp.corners[corner]], smooth.normals[smooth.corners[corner]]);
}

/// The reference: the triangles that are reached from a corner's over edges at its position that are not sharp.
Vec3d normalAround(const Mesh& mesh, std::size_t corner) {
  const auto positionOf = [&](std::size_t each) { return mesh.wedgePositions[mesh.corners[each]]; };
  const std::uint32_t position = positionOf(corner);
  const auto hasPosition = [&](std::size_t first, std::uint32_t other) {
    return positionOf(first) == other || positionOf(first + 1) == other || positionOf(first + 2) == other;
  };
  std::vector<std::size_t> reached{corner - corner % 3};
  Vec3d sum;
  for (std::size_t at = 0; at < reached.size(); ++at) {
    const Vec3d here = facetNormal(mesh, reached[at]);
    sum += here;
    for (std::size_t first = 0; first < mesh.corners.size(); first += 3) {
      if (!hasPosition(first, position) || std::ranges::find(reached, first) != reached.end())
        continue;
      const Vec3d there = facetNormal(mesh, first);
      bool meet = false;
      for (std::size_t i = 0; i < 3; ++i)
        meet |= positionOf(first + i) != position && hasPosition(reached[at], positionOf(first + i));
      if (meet && degreesBetween(Vec3f(here), Vec3f(there)) <= mesh.creaseDegrees)
        reached.push_back(first);
    }
  }
  return sum;
}

TEST(Normals, AgreeWithTheReferenceWhereThereAreCreases) {
  testing::Random random(3);
  for (const double degrees : {5.0, 15.0, 40.0}) {
    Mesh mesh = testing::torus(24, 12);
    mesh.normals.clear(), mesh.texCoords.clear();
    for (Vec3f& position : mesh.positions)
      position += random.point() * 0.05f;
    weld(mesh);
    mesh.creaseDegrees = degrees;
    Mesh creased = mesh;
    computeNormals(creased, NormalWeighting::area);
    ASSERT_TRUE(isConsistent(creased));
    EXPECT_GT(creased.wedgeCount(), mesh.wedgeCount());
    ASSERT_EQ(creased.corners.size(), mesh.corners.size());
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
      EXPECT_EQ(creased.cornerPosition(corner), mesh.cornerPosition(corner));
      const Vec3d expected = normalAround(mesh, corner);
      EXPECT_LT(degreesBetween(creased.normals[creased.corners[corner]], Vec3f(expected * (1 / length(expected)))),
                0.1);
    }
  }
}

TEST(Normals, WithCreasesKeepTheAttributesOfWedges) {
  Mesh mesh = testing::boxes(1);
  for (std::size_t i = 0; i < mesh.wedgeCount(); ++i) {
    mesh.texCoords.push_back({static_cast<float>(i), 0});
    mesh.colors.push_back(Rgba(static_cast<float>(i) / 8, 0, 0, 1));
  }
  const Mesh before = mesh;
  mesh.creaseDegrees = 30;
  computeNormals(mesh, NormalWeighting::area);
  ASSERT_TRUE(isConsistent(mesh));
  EXPECT_EQ(gather(mesh.texCoords, mesh.corners), gather(before.texCoords, before.corners));
  EXPECT_EQ(gather(mesh.colors, mesh.corners), gather(before.colors, before.corners));
}

TEST(Normals, AreDividedAtEdgesOfManyTrianglesInTheirTimeAlone) {
  for (const std::uint32_t count : {16u, 17u, 200'000u}) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}};
    mesh.positions.resize(2 + count);
    for (std::uint32_t i = 0; i < count; ++i)
      mesh.positions[2 + i] = {1, static_cast<float>(i) * 1e-7f, 0};
    testing::addPlainWedges(mesh);
    for (std::uint32_t i = 0; i < count; ++i)
      testing::addTriangle(mesh, 0, 1, 2 + i);
    mesh.creaseDegrees = 30;
    computeNormals(mesh, NormalWeighting::area);
    EXPECT_EQ(mesh.wedgeCount() == mesh.positions.size(), count <= 16) << count;
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
