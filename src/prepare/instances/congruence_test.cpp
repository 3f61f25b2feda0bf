#include "prepare/instances/congruence.h"

#include "prepare/instances/best_rotation.h"
#include "prepare/instances/find_instances.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace imgeo {
namespace {

using testing::Random;

constexpr CongruenceTolerance tolerance{.distance = 1e-5};

/// A box of the given edges, about the origin, without attributes.
Mesh boxMesh(Vec3d edges) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(
        Vec3f(Vec3d{i & 1 ? edges.x : -edges.x, i & 2 ? edges.y : -edges.y, i & 4 ? edges.z : -edges.z} * 0.5));
  mesh.wedgePositions = {0, 1, 2, 3, 4, 5, 6, 7};
  mesh.corners = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
  return mesh;
}

/// Random triangles without any symmetry, with normals and colours of their vertices.
Mesh irregularMesh(Random& random, std::uint32_t vertices = 12) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i) {
    mesh.positions.push_back(random.point());
    mesh.wedgePositions.push_back(i);
    const Vec3d direction(random.point());
    mesh.normals.push_back(Vec3f(direction * (1 / length(direction))));
    mesh.colors.push_back(Rgba8{static_cast<std::uint8_t>(17 * i), 3, 5, 255});
    if (i >= 2)
      for (const std::uint32_t corner : {i - 2, i - 1, i})
        mesh.corners.push_back(corner);
  }
  return mesh;
}

Affine3d randomRigidMap(Random& random) {
  Affine3d map = affineOf(Rotation{Vec3d(random.point()), 3.0 * random.point().x});
  map.translation = Vec3d(random.point()) * 5;
  return map;
}

Mesh moved(Mesh mesh, const Affine3d& map) {
  for (Vec3f& position : mesh.positions)
    position = Vec3f(map.point(Vec3d(position)));
  for (Vec3f& normal : mesh.normals)
    normal = Vec3f(map.direction(Vec3d(normal)));
  return mesh;
}

/// The same mesh with positions, wedges and elements in another order, and other first corners.
Mesh shuffled(const Mesh& mesh, Random& random) {
  const auto order = [&](std::size_t count) {
    std::vector<std::uint32_t> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0u);
    for (std::size_t i = count; i > 1; --i)
      std::swap(numbers[i - 1], numbers[random.below(static_cast<std::uint32_t>(i))]);
    return numbers;
  };
  Mesh result = mesh;
  const std::vector<std::uint32_t> positions = order(mesh.positions.size()), wedges = order(mesh.wedgeCount()),
                                   elements = order(mesh.elementCount());
  std::vector<std::uint32_t> newPosition(positions.size()), newWedge(wedges.size());
  for (std::uint32_t i = 0; i < positions.size(); ++i)
    newPosition[positions[i]] = i;
  for (std::uint32_t i = 0; i < wedges.size(); ++i)
    newWedge[wedges[i]] = i;
  result.positions = gather(mesh.positions, positions);
  static_cast<VertexAttributes&>(result) = gather(mesh, wedges);
  result.wedgePositions = gather(mesh.wedgePositions, wedges);
  for (std::uint32_t& position : result.wedgePositions)
    position = newPosition[position];
  result.corners.clear();
  for (const std::uint32_t element : elements) {
    const std::uint32_t first = random.below(3);
    for (std::uint32_t i = 0; i < 3; ++i)
      result.corners.push_back(newWedge[mesh.corners[3 * element + (first + i) % 3]]);
  }
  return result;
}

std::optional<Transform> mapOf(const Mesh& from, const Mesh& to) {
  return findRigidMap(from, measureOf(from), to, measureOf(to), tolerance);
}

/// The largest distance of a moved position from the nearest one of the other mesh.
double distanceOf(const Mesh& from, const Mesh& to, const Affine3d& map) {
  double largest = 0;
  for (const Vec3f& position : from.positions) {
    double nearest = INFINITY;
    for (const Vec3f& other : to.positions)
      nearest = std::min(nearest, length(map.point(Vec3d(position)) - Vec3d(other)));
    largest = std::max(largest, nearest);
  }
  return largest;
}

TEST(BestRotation, RecoversARotationOfPairs) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Affine3d rotation = affineOf(Rotation{Vec3d(random.point()), 3.0 * random.point().x});
    PairSums sums;
    for (int pair = 0; pair < 5; ++pair) {
      const Vec3d a(random.point());
      sums.add(a, rotation.direction(a));
    }
    const Affine3d found = bestRotation(sums);
    for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
      EXPECT_LE(length(found.direction(axis) - rotation.direction(axis)), 1e-9);
  }
}

TEST(FindRigidMap, FindsMovedAndTurnedMeshesInTheSameOrder) {
  Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Mesh mesh = irregularMesh(random), other = moved(mesh, randomRigidMap(random));
    const std::optional<Transform> map = mapOf(mesh, other);
    ASSERT_TRUE(map) << i;
    EXPECT_LE(distanceOf(mesh, other, affineOf(*map)), tolerance.distance);
    EXPECT_EQ(map->scale, (Vec3d{1, 1, 1}));
  }
}

TEST(FindRigidMap, FindsThemInAnyOrderOfVerticesAndTriangles) {
  Random random(7);
  for (int i = 0; i < 100; ++i) {
    const Mesh mesh = irregularMesh(random, 40), other = shuffled(moved(mesh, randomRigidMap(random)), random);
    const std::optional<Transform> map = mapOf(mesh, other);
    ASSERT_TRUE(map) << i;
    EXPECT_LE(distanceOf(mesh, other, affineOf(*map)), tolerance.distance);
  }
}

TEST(FindRigidMap, FindsBoxesAndCubesInAnyOrder) {
  Random random(9);
  for (const Vec3d edges : {Vec3d{1, 2, 3}, Vec3d{2, 2, 3}, Vec3d{2, 2, 2}})
    for (int i = 0; i < 50; ++i) {
      const Mesh mesh = boxMesh(edges), other = shuffled(moved(mesh, randomRigidMap(random)), random);
      const std::optional<Transform> map = mapOf(mesh, other);
      // A cube has a diagonal on each side, which not all of its rotations keep.
      ASSERT_TRUE(map) << edges.y << " " << i;
      EXPECT_LE(distanceOf(mesh, other, affineOf(*map)), tolerance.distance);
    }
}

TEST(FindRigidMap, PrefersNothingAndTranslationsToRotations) {
  Random random(11);
  const Mesh mesh = irregularMesh(random);
  EXPECT_EQ(mapOf(mesh, mesh), Transform{});
  Affine3d translation;
  translation.translation = {1, 2, 3};
  const std::optional<Transform> map = mapOf(mesh, moved(mesh, translation));
  ASSERT_TRUE(map);
  EXPECT_EQ(map->rotation, Rotation{});
  EXPECT_EQ(map->translation, (Vec3d{1, 2, 3}));
}

TEST(FindRigidMap, RefusesMirroredMeshesWithoutSymmetry) {
  Random random(13);
  for (int i = 0; i < 50; ++i) {
    const Mesh mesh = irregularMesh(random);
    Mesh mirrored = mesh;
    for (Vec3f& position : mirrored.positions)
      position.x = -position.x;
    for (Vec3f& normal : mirrored.normals)
      normal.x = -normal.x;
    EXPECT_FALSE(mapOf(mesh, mirrored)) << i;
    for (std::size_t corner = 0; corner < mirrored.corners.size(); corner += 3)
      std::swap(mirrored.corners[corner], mirrored.corners[corner + 1]);
    EXPECT_FALSE(mapOf(mesh, mirrored)) << i;
  }
}

TEST(FindRigidMap, RefusesDifferences) {
  Random random(15);
  const Mesh mesh = irregularMesh(random);
  Mesh other = moved(mesh, randomRigidMap(random));
  ASSERT_TRUE(mapOf(mesh, other));
  const auto changed = [&](const auto& change) {
    Mesh copy = other;
    change(copy);
    return copy;
  };
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { copy.positions[3].y += 1e-3f; })));
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { copy.colors[3] = Rgba8{1, 2, 3, 255}; })));
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { copy.normals[3] = copy.normals[3] * -1; })));
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { std::swap(copy.corners[0], copy.corners[1]); })));
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { copy.corners[0] = 7; })));
  EXPECT_FALSE(mapOf(mesh, changed([](Mesh& copy) { copy.colors.clear(); })));
  for (Vec3f& position : other.positions)
    position = position * 1.01f;
  EXPECT_FALSE(mapOf(mesh, other));
}

TEST(FindRigidMap, OnlyTranslatesMeshesWithDirections) {
  Random random(17);
  Mesh mesh = irregularMesh(random);
  mesh.namedAttributes.push_back({"flow", 3, std::vector<float>(3 * mesh.wedgeCount(), 0.5f)});
  EXPECT_FALSE(mapOf(mesh, moved(mesh, affineOf(Rotation{{0, 0, 1}, 1}))));
  Affine3d translation;
  translation.translation = {1, 2, 3};
  EXPECT_TRUE(mapOf(mesh, moved(mesh, translation)));
}

TEST(FindInstances, NamesTheFirstMeshOfEachClass) {
  Random random(19);
  const Mesh a = irregularMesh(random), b = boxMesh({1, 2, 3});
  std::vector<Mesh> meshes{b, a};
  for (int i = 0; i < 40; ++i)
    meshes.push_back(shuffled(moved(i % 2 == 0 ? a : b, randomRigidMap(random)), random));
  InstanceSearch search{
      std::vector<std::optional<std::uint64_t>>(meshes.size(), 0), {}, [](const Box3d&) { return tolerance.distance; }};
  for (std::size_t i = 0; i < meshes.size(); ++i)
    search.order.push_back(i);
  const auto instances = findInstances(meshes, search);
  EXPECT_FALSE(instances[0]);
  EXPECT_FALSE(instances[1]);
  for (std::size_t i = 2; i < meshes.size(); ++i) {
    ASSERT_TRUE(instances[i]) << i;
    EXPECT_EQ(instances[i]->mesh, i % 2 == 0 ? 1u : 0u);
    EXPECT_LE(instances[i]->distance, tolerance.distance + 10 * std::ldexp(1.0, -22));
  }
  search.kinds[4] = 1;
  EXPECT_FALSE(findInstances(meshes, search)[4]);
}

InstanceSearch searchOfSmall(std::size_t count, std::size_t minSmallClass) {
  InstanceSearch search{std::vector<std::optional<std::uint64_t>>(count, 0),
                        {},
                        [](const Box3d&) { return tolerance.distance; },
                        std::vector<bool>(count, true),
                        minSmallClass};
  for (std::size_t i = 0; i < count; ++i)
    search.order.push_back(i);
  return search;
}

TEST(FindInstances, NeedsTheSameCoordinatesOfSmallMeshesOfWhichFewAreEqual) {
  Random random(23);
  const Mesh box = boxMesh({1, 2, 3});
  Affine3d aside;
  aside.translation = {5, 0, 0};
  std::vector<Mesh> meshes{box, moved(box, aside), shuffled(box, random), box};
  for (int i = 0; i < 100; ++i) // as large, and elsewhere
    meshes.push_back(moved(box, randomRigidMap(random)));
  meshes.push_back(meshes[50]);
  const auto instances = findInstances(meshes, searchOfSmall(meshes.size(), meshes.size() + 1));
  for (std::size_t i = 0; i + 1 < meshes.size(); ++i)
    EXPECT_EQ(instances[i].has_value(), i == 3) << i;
  ASSERT_TRUE(instances[3] && instances.back());
  EXPECT_EQ(instances[3]->mesh, 0u);
  EXPECT_EQ(instances.back()->mesh, 50u);
  EXPECT_EQ(instances.back()->transform, Transform{});
}

TEST(FindInstances, MovesSmallMeshesOfWhichManyAreEqual) {
  Random random(29);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 12; ++i) // seven of one size and five of another
    meshes.push_back(moved(boxMesh({1, 2, i % 5 < 3 && i < 11 ? 3.f : 4.f}), randomRigidMap(random)));
  const auto instances = findInstances(meshes, searchOfSmall(meshes.size(), 7));
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const bool isOfMany = i % 5 < 3 && i < 11;
    EXPECT_EQ(instances[i].has_value(), isOfMany && i > 0) << i;
    EXPECT_EQ(instances[i] ? instances[i]->mesh : 0u, 0u);
  }
}

} // namespace
} // namespace imgeo
