#include "prepare/levels/levels.h"

#include "base/parallel.h"
#include "prepare/base_mesh_testing.h"
#include "prepare/levels/coarse_form.h"
#include "prepare/levels/drop_pieces.h"
#include "prepare/levels/group_borders.h"
#include "scene/testing.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace imgeo {
namespace {

using namespace testing;

/// All groups of a mesh in the order of `levels`.
struct BuiltLevels {
  Levels levels;
  std::vector<GroupMesh> meshes;
  Mesh source;
  std::vector<Vec3u> points; ///< of the source

  std::size_t levelCount() const { return levels.groups.front().level + 1; }
};

BuiltLevels build(const Mesh& mesh, std::uint32_t groupTriangles, std::uint32_t bits = 14,
                  std::uint32_t regionTriangles = defaultRegionTriangles,
                  std::uint32_t rootTriangles = LevelOptions{}.rootTriangles) {
  BuiltLevels built;
  built.source = mesh;
  built.points = quantise(mesh.positions, latticeFor(boxOf(mesh), bits));
  std::vector<std::vector<GroupMesh>> byLevel;
  const GroupSink sink{
      [&](std::uint32_t level, std::size_t count) {
        EXPECT_EQ(level, byLevel.size());
        byLevel.emplace_back(count);
      },
      [&](std::uint32_t level, std::size_t group, GroupMesh each) { byLevel[level][group] = std::move(each); }};
  built.levels = buildLevels(
      mesh, built.points,
      {.groupTriangles = groupTriangles, .rootTriangles = rootTriangles, .regionTriangles = regionTriangles}, sink);
  for (std::size_t level = byLevel.size(); level-- > 0;)
    for (GroupMesh& each : byLevel[level])
      built.meshes.push_back(std::move(each));
  EXPECT_EQ(built.meshes.size(), built.levels.groups.size());
  return built;
}

using PointTriangle = std::array<PointKey, 3>;

PointTriangle pointTriangleOf(const Patch& patch, std::size_t triangle) {
  PointTriangle result;
  for (std::size_t i = 0; i < 3; ++i)
    result[i] = keyOf(patch.positions[patch.wedgePositions[patch.corners[3 * triangle + i]]]);
  std::ranges::rotate(result, std::ranges::min_element(result));
  return result;
}

/// How often each triangle of lattice points occurs.
std::map<PointTriangle, int> quantisedTriangles(const Mesh& mesh, const std::vector<Vec3u>& points) {
  std::map<PointTriangle, int> counts;
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    PointTriangle triangle;
    for (std::size_t i = 0; i < 3; ++i)
      triangle[i] = keyOf(points[mesh.wedgePositions[mesh.corners[corner + i]]]);
    std::ranges::rotate(triangle, std::ranges::min_element(triangle));
    ++counts[triangle];
  }
  return counts;
}

std::map<PointTriangle, int> trianglesOnLevel(const BuiltLevels& built, std::uint32_t level) {
  std::map<PointTriangle, int> counts;
  for (std::size_t group = 0; group < built.meshes.size(); ++group)
    for (std::size_t i = 0; built.levels.groups[group].level == level && i < built.meshes[group].patch.elementCount();
         ++i)
      ++counts[pointTriangleOf(built.meshes[group].patch, i)];
  return counts;
}

/// The groups of a level; their children are indices into the level below.
std::vector<GroupTriangles> groupsOn(const BuiltLevels& built, std::uint32_t level) {
  std::uint32_t below = 0;
  for (const LeveledGroup& group : built.levels.groups)
    below += group.level >= level;
  std::vector<GroupTriangles> groups;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    if (built.levels.groups[number].level != level)
      continue;
    const GroupMesh& mesh = built.meshes[number];
    GroupTriangles group;
    group.positions = mesh.patch.positions;
    for (const std::uint32_t wedge : mesh.patch.corners)
      group.corners.push_back(mesh.patch.wedgePositions[wedge]);
    group.segments = mesh.segments;
    for (const std::uint32_t child : built.levels.groups[number].children)
      group.children.push_back(child - below);
    groups.push_back(std::move(group));
  }
  return groups;
}

/// The first group of a level of which the coarse form, in the groups of the level above, has another border.
std::optional<std::size_t> groupWithOtherBorder(const std::vector<GroupTriangles>& level,
                                                const std::vector<GroupTriangles>& above) {
  std::vector<std::vector<Vec3u>> borders;
  for (const GroupTriangles& group : level)
    borders.push_back(borderPointsOf(group));
  const SharedBorderPoints shared(borders);
  std::vector<GroupTriangles> forms(level.size());
  for (const GroupTriangles& parent : above)
    for (std::uint32_t segment = 0; segment < parent.children.size(); ++segment)
      appendSegment(forms[parent.children[segment]], parent, segment);
  for (std::size_t group = 0; group < level.size(); ++group)
    if (hasOtherBorder(level[group], forms[group], shared))
      return group;
  return std::nullopt;
}

void expectBordersKept(const BuiltLevels& built) {
  for (std::uint32_t level = 0; level + 1 < built.levelCount(); ++level)
    EXPECT_EQ(groupWithOtherBorder(groupsOn(built, level), groupsOn(built, level + 1)), std::nullopt) << level;
}

/// Opens groups at random, each when all its parents are open, and returns which are open.
std::vector<bool> randomCut(const BuiltLevels& built, Random& random) {
  const std::vector<LeveledGroup>& groups = built.levels.groups;
  std::vector<bool> isOpen(groups.size()), mayOpen(groups.size(), true);
  const std::uint32_t rarity = 1 + random.below(6);
  for (std::size_t number = 0; number < groups.size(); ++number) {
    isOpen[number] = number < built.levels.rootCount || (mayOpen[number] && !random.oneIn(rarity + 1));
    for (const std::uint32_t child : groups[number].children)
      mayOpen[child] = mayOpen[child] && isOpen[number];
  }
  return isOpen;
}

/// The triangles that a cut draws.
std::vector<PointTriangle> drawnBy(const BuiltLevels& built, const std::vector<bool>& isOpen) {
  std::vector<PointTriangle> drawn;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    const GroupMesh& mesh = built.meshes[number];
    for (std::size_t triangle = 0; isOpen[number] && triangle < mesh.patch.elementCount(); ++triangle)
      if (mesh.segments.empty() || !isOpen[built.levels.groups[number].children[mesh.segments[triangle]]])
        drawn.push_back(pointTriangleOf(mesh.patch, triangle));
  }
  return drawn;
}

void expectClosedCuts(const BuiltLevels& built, int count) {
  Random random(static_cast<std::uint32_t>(built.meshes.size()));
  for (int cut = 0; cut < count; ++cut) {
    EdgeBalance edges;
    const auto pointOf = [](const PointKey& key) {
      return Vec3u{std::get<0>(key), std::get<1>(key), std::get<2>(key)};
    };
    for (const PointTriangle& triangle : drawnBy(built, randomCut(built, random)))
      edges.add(pointOf(triangle[0]), pointOf(triangle[1]), pointOf(triangle[2]));
    EXPECT_EQ(edges.cracks(), 0u) << "cut " << cut;
  }
}

/// A closed, bumpy surface with two further components, one of which is tiny.
Mesh threePieces(std::uint32_t size) {
  Mesh mesh = torus(size, size);
  mesh.texCoords.clear();
  Random random(1);
  for (Vec3f& position : mesh.positions)
    position += random.point() * (0.4f / static_cast<float>(size));
  const auto addSphere = [&](std::uint32_t rings, float radius, Vec3f center) {
    const Mesh piece = sphere(rings, rings);
    const auto positions = static_cast<std::uint32_t>(mesh.positions.size());
    const auto wedges = static_cast<std::uint32_t>(mesh.wedgeCount());
    for (const Vec3f& position : piece.positions)
      mesh.positions.push_back(position * radius + center);
    for (const std::uint32_t position : piece.wedgePositions)
      mesh.wedgePositions.push_back(positions + position);
    mesh.normals.insert(mesh.normals.end(), piece.normals.begin(), piece.normals.end());
    for (const std::uint32_t corner : piece.corners)
      mesh.corners.push_back(wedges + corner);
  };
  addSphere(size / 2, 0.3f, {0, 0.5f, 0});
  addSphere(4, 0.01f, {0, -0.5f, 0});
  return mesh;
}

TEST(Levels, HaveEveryTriangleOfTheQuantisedMeshOnceOnLevel0) {
  for (const Mesh& mesh : {threePieces(40), grid(30), soup(1000, 2), nonManifold(), sphere(3, 3)}) {
    const BuiltLevels built = build(mesh, 300, 10);
    EXPECT_EQ(trianglesOnLevel(built, 0), quantisedTriangles(mesh, built.points)) << mesh.name;
  }
}

TEST(Levels, HaveGroupsThatAreAsFullAsTheyCanBe) {
  const BuiltLevels built = build(threePieces(60), 1000);
  std::map<std::uint32_t, std::size_t> groups, triangles;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    const std::size_t count = built.meshes[number].patch.elementCount();
    EXPECT_LE(count, 1000u);
    EXPECT_GE(count, 1u);
    ++groups[built.levels.groups[number].level];
    triangles[built.levels.groups[number].level] += count;
  }
  for (const auto& [level, count] : groups)
    EXPECT_EQ(count, (triangles[level] + 999) / 1000) << level;
}

TEST(Levels, HaveAQuarterOfTheTrianglesOfTheLevelBelow) {
  const BuiltLevels built = build(threePieces(120), 2000);
  ASSERT_GE(built.levelCount(), 3u);
  std::map<std::uint32_t, double> triangles;
  for (std::size_t number = 0; number < built.meshes.size(); ++number)
    triangles[built.levels.groups[number].level] += static_cast<double>(built.meshes[number].patch.elementCount());
  for (std::uint32_t level = 1; level < built.levelCount(); ++level)
    EXPECT_NEAR(triangles[level] / triangles[level - 1], 0.25, 0.06) << level;
  EXPECT_EQ(built.levels.rootCount, 1u);
}

TEST(Levels, AreClosedForEveryLegalCutOfAClosedMesh) {
  for (const std::uint32_t groupTriangles : {300u, 2000u}) {
    const BuiltLevels built = build(threePieces(60), groupTriangles);
    ASSERT_GE(built.levelCount(), 2u);
    expectBordersKept(built);
    expectClosedCuts(built, 20);
  }
}

TEST(Levels, AreClosedForEveryLegalCutAcrossRegions) {
  for (const std::uint32_t regionTriangles : {700u, 3000u}) {
    const BuiltLevels built = build(threePieces(60), 300, 14, regionTriangles);
    ASSERT_GE(built.levelCount(), 3u);
    EXPECT_EQ(trianglesOnLevel(built, 0), quantisedTriangles(built.source, built.points));
    expectBordersKept(built);
    expectClosedCuts(built, 20);
  }
}

TEST(Levels, KeepBordersAcrossRegionsOfOpenAndNonManifoldMeshes) {
  for (const Mesh& mesh : {grid(60), nonManifold(), soup(600, 3)})
    expectBordersKept(build(mesh, 64, 12, 200));
}

TEST(Levels, AreClosedOnALatticeWhereManyVerticesFallTogether) {
  const BuiltLevels built = build(threePieces(90), 1200, 8);
  expectBordersKept(built);
  expectClosedCuts(built, 10);
}

TEST(Levels, KeepBordersOfOpenNonManifoldDegenerateAndTinyMeshes) {
  Mesh twoSided = grid(40); // every triangle again in the other orientation: edges with four triangles
  const std::size_t count = twoSided.corners.size();
  for (std::size_t corner = 0; corner < count; corner += 3)
    addTriangle(twoSided, twoSided.corners[corner], twoSided.corners[corner + 2], twoSided.corners[corner + 1]);
  Mesh threeLeaves = grid(30); // three sheets that meet at an edge
  for (int leaf = 0; leaf < 2; ++leaf) {
    const Mesh other = grid(30);
    const auto first = static_cast<std::uint32_t>(threeLeaves.positions.size());
    for (const Vec3f& position : other.positions)
      threeLeaves.positions.push_back({leaf == 0 ? -position.x : 0, position.y, leaf == 0 ? position.z : position.x});
    addPlainWedges(threeLeaves);
    for (const std::uint32_t corner : other.corners)
      threeLeaves.corners.push_back(first + corner);
  }
  for (const Mesh& mesh : {grid(60), twoSided, threeLeaves, nonManifold(), soup(600, 3), sphere(2, 3)}) {
    const BuiltLevels built = build(mesh, 300, 12);
    expectBordersKept(built);
  }
  const BuiltLevels built = build(twoSided, 300, 12);
  EXPECT_GE(built.levelCount(), 2u);
  expectClosedCuts(built, 10);
}

TEST(Levels, WithAMovedBorderVertexAreFound) {
  const BuiltLevels built = build(threePieces(60), 1000);
  std::vector<GroupTriangles> above = groupsOn(built, 1);
  const std::vector<GroupTriangles> below = groupsOn(built, 0);
  ASSERT_EQ(groupWithOtherBorder(below, above), std::nullopt);
  std::set<PointKey> ofFirst, shared;
  for (const Vec3u& position : below[0].positions)
    ofFirst.insert(keyOf(position));
  for (const Vec3u& position : below[1].positions)
    if (ofFirst.contains(keyOf(position)))
      shared.insert(keyOf(position));
  ASSERT_FALSE(shared.empty());
  for (GroupTriangles& group : above)
    for (Vec3u& position : group.positions)
      if (keyOf(position) == *shared.begin()) {
        ++position.x;
        EXPECT_NE(groupWithOtherBorder(below, above), std::nullopt);
        return;
      }
  FAIL() << "no group above has the shared vertex";
}

/// The triangles of a level.
PatchTriangles surfaceOn(const BuiltLevels& built, std::uint32_t level) {
  PatchTriangles surface;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    if (built.levels.groups[number].level != level)
      continue;
    const PatchTriangles triangles = trianglesOf(built.meshes[number].patch);
    const auto first = static_cast<std::uint32_t>(surface.positions.size());
    surface.positions.insert(surface.positions.end(), triangles.positions.begin(), triangles.positions.end());
    for (const std::uint32_t corner : triangles.corners)
      surface.corners.push_back(first + corner);
  }
  return surface;
}

/// Calls back for each level but level 0 with the largest error that is stated of it, and the true one.
void forErrors(const BuiltLevels& built, const std::function<void(std::uint32_t level, double stated, double)>& take) {
  PatchTriangles source;
  source.positions = built.points;
  for (const std::uint32_t corner : built.source.corners)
    source.corners.push_back(built.source.wedgePositions[corner]);
  for (std::uint32_t level = 1; level < built.levelCount(); ++level) {
    double stated = 0;
    for (const LeveledGroup& group : built.levels.groups)
      if (group.level + 1 == level)
        stated = std::max(stated, group.error);
    take(level, stated, coarseError(source, surfaceOn(built, level), true));
  }
}

TEST(Levels, StateErrorsThatAreTrueAndNoMoreThanTwiceTheLargestOfTheirLevel) {
  for (const Mesh& mesh : {threePieces(90), grid(90)}) {
    const BuiltLevels built = build(mesh, 1200, 16);
    ASSERT_GE(built.levelCount(), 3u);
    forErrors(built, [&](std::uint32_t level, double stated, double largest) {
      EXPECT_GE(stated, largest) << mesh.name << " level " << level;
      // Bounds of the levels below add up; at a root of some hundred triangles of a rough surface to a little more.
      EXPECT_LE(stated, (level + 1 < built.levelCount() ? 2.0 : 2.5) * largest) << mesh.name << " level " << level;
    });
  }
}

TEST(Levels, StateErrorsLargerThanThoseOfChildren) {
  const BuiltLevels built = build(threePieces(60), 500);
  for (std::size_t number = built.levels.rootCount; number < built.meshes.size(); ++number)
    for (const std::uint32_t child : built.levels.groups[number].children)
      EXPECT_GE(built.levels.groups[number].error, built.levels.groups[child].error);
}

/// Cubes of different sizes, one in each cell of a grid of unit cells: none touches another while edges, which are
/// minEdge to minEdge + edgeRange long, are shorter than 1.
Mesh boxes(int count, float minEdge = 0.2f, float edgeRange = 0.6f) {
  Mesh mesh;
  const int perRow = static_cast<int>(std::sqrt(count));
  for (int n = 0; n < count; ++n) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const float edge = minEdge + edgeRange * static_cast<float>(n * 7 % 11) / 11;
    for (int i = 0; i < 8; ++i)
      mesh.positions.push_back({static_cast<float>(n % perRow) + (i & 1 ? edge : 0.f),
                                static_cast<float>(n / perRow) + (i & 2 ? edge : 0.f), i & 4 ? edge : 0.f});
    for (const std::uint32_t corner :
         {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5})
      mesh.corners.push_back(first + corner);
  }
  mesh.wedgePositions.resize(mesh.positions.size());
  std::iota(mesh.wedgePositions.begin(), mesh.wedgePositions.end(), 0u);
  return mesh;
}

TEST(Levels, OfUnconnectedPiecesLeaveSmallOnesOutAndStateHowFarTheyAre) {
  for (const Mesh& mesh : {soup(2400, 1), boxes(1600)}) {
    const BuiltLevels built = build(mesh, 1200, 14);
    EXPECT_EQ(built.levels.rootCount, 1u);
    EXPECT_GE(built.levelCount(), 2u);
    expectBordersKept(built);
    forErrors(built, [&](std::uint32_t level, double stated, double largest) {
      EXPECT_TRUE(std::isfinite(stated));
      EXPECT_GE(stated, largest) << level;
    });
  }
  expectClosedCuts(build(boxes(1600), 1200, 14), 20);
}

TEST(Levels, EndWithARootOfFewTrianglesUnlessThatIsFarFromTheLevelBelow) {
  const auto countsOf = [](const Mesh& mesh) {
    const BuiltLevels built = build(mesh, 4800, 14, defaultRegionTriangles, 500);
    std::vector<std::size_t> counts; // triangles by level, from the root
    for (std::size_t number = 0; number < built.meshes.size(); ++number) {
      counts.resize(built.levelCount() - built.levels.groups[number].level);
      counts.back() += built.meshes[number].patch.elementCount();
    }
    EXPECT_EQ(built.levels.rootCount, 1u);
    expectBordersKept(built);
    return counts;
  };
  const std::vector<std::size_t> ofSphere = countsOf(sphere(80, 60));
  ASSERT_GE(ofSphere.size(), 3u);
  EXPECT_LE(ofSphere[0], 500u);
  EXPECT_GT(ofSphere[1], 500u);
  EXPECT_LE(ofSphere[1], 4800u);
  const std::vector<std::size_t> ofBoxes = countsOf(boxes(1600));
  ASSERT_EQ(ofBoxes.size(), 2u);
  EXPECT_GT(ofBoxes[0], 500u);
}

TEST(CoarseErrors, OfPiecesThatVanishAreTheirDiagonalsOnLevel0WhereTheseAreLess) {
  const PatchTriangles form{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}}, {0, 1, 2}};
  PatchTriangles group = form;
  group.positions.insert(group.positions.end(), {{0, 0, 1000}, {3, 0, 1000}, {0, 4, 1000}});
  group.corners.insert(group.corners.end(), {3, 4, 5});
  EXPECT_EQ(coarseError(group, form, true), 5);
  EXPECT_EQ(coarseError(group, form, false), 1000);
  group.positions.push_back({0, 0, 40}); // joins both, so that nothing small vanishes
  group.corners.insert(group.corners.end(), {0, 6, 3});
  EXPECT_EQ(coarseError(group, form, true), 1000);
  EXPECT_EQ(coarseError(form, form, true), 0);
}

TEST(Levels, KeepSmallPiecesWholeOrLeaveThemOut) {
  const BuiltLevels built = build(boxes(1600), 1200, 14);
  const Patch& root = built.meshes.front().patch;
  const std::vector<std::uint32_t> corners = gather(root.wedgePositions, root.corners);
  const auto pieces = static_cast<double>(countPieces(root.positions.size(), corners));
  EXPECT_GE(pieces, 20);
  EXPECT_GE(static_cast<double>(root.elementCount()) / pieces, 11) << "triangles of a piece, of which a box has 12";
}

TEST(Levels, KeepPiecesApartWhoseGapsAreSmallerThanTheRoundingOfPositions) {
  const BuiltLevels built = build(boxes(1600, 0.97f, 0.02f), 1200, 14);
  ASSERT_EQ(built.levels.rootCount, 1u);
  const Patch& root = built.meshes.front().patch;
  const std::vector<std::uint32_t> corners = gather(root.wedgePositions, root.corners);
  EXPECT_EQ(12 * countPieces(root.positions.size(), corners), root.elementCount());
}

TEST(Levels, KeepLooseSpecks) {
  const BuiltLevels built = build(threePieces(60), 1000);
  const GroupMesh& root = built.meshes.front();
  const Vec3u low = built.points.back(); // of the tiny sphere
  const bool isThere = std::ranges::any_of(
      root.patch.positions, [&](const Vec3u& position) { return length(Vec3d(position) - Vec3d(low)) < 300; });
  EXPECT_TRUE(isThere);
}

TEST(Levels, DoNotDependOnThreads) {
  const Mesh mesh = threePieces(60);
  limitThreads(1);
  const BuiltLevels one = build(mesh, 500);
  limitThreads(4);
  const BuiltLevels four = build(mesh, 500);
  limitThreads(0);
  ASSERT_EQ(one.meshes.size(), four.meshes.size());
  for (std::size_t number = 0; number < one.meshes.size(); ++number) {
    EXPECT_EQ(one.meshes[number].patch.positions, four.meshes[number].patch.positions);
    EXPECT_EQ(one.meshes[number].patch.corners, four.meshes[number].patch.corners);
    EXPECT_EQ(one.meshes[number].patch.normals, four.meshes[number].patch.normals);
    EXPECT_EQ(one.meshes[number].segments, four.meshes[number].segments);
    EXPECT_EQ(one.levels.groups[number].children, four.levels.groups[number].children);
    EXPECT_EQ(one.levels.groups[number].error, four.levels.groups[number].error);
  }
}

TEST(Levels, HaveTheNormalsOfTheLevelBelowWhereTheyMeetIt) {
  const BuiltLevels built = build(threePieces(60), 1000);
  std::map<PointKey, std::set<std::size_t>> groupsAt; // of level 0
  std::map<PointKey, Vec3f> normals;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    const Patch& patch = built.meshes[number].patch;
    for (std::size_t wedge = 0; built.levels.groups[number].level == 0 && wedge < patch.wedgeCount(); ++wedge) {
      groupsAt[keyOf(patch.positions[patch.wedgePositions[wedge]])].insert(number);
      normals[keyOf(patch.positions[patch.wedgePositions[wedge]])] = patch.normals[wedge];
    }
  }
  std::size_t met = 0;
  for (std::size_t number = 0; number < built.meshes.size(); ++number) {
    const Patch& patch = built.meshes[number].patch;
    for (std::size_t wedge = 0; built.levels.groups[number].level == 1 && wedge < patch.wedgeCount(); ++wedge) {
      const PointKey key = keyOf(patch.positions[patch.wedgePositions[wedge]]);
      if (const auto at = groupsAt.find(key); at != groupsAt.end() && at->second.size() > 1) {
        ++met;
        EXPECT_EQ(patch.normals[wedge], normals[key]);
      }
    }
  }
  EXPECT_GT(met, 100u);
}

TEST(Levels, KeepCreases) {
  Mesh mesh; // the sides of a cube, each with wedges of its own
  constexpr std::uint32_t n = 24;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const float sign = side % 2 == 0 ? 1.0f : -1.0f;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::uint32_t y = 0; y <= n; ++y)
      for (std::uint32_t x = 0; x <= n; ++x) {
        Vec3f position, normal;
        position[axis] = sign;
        position[(axis + 1) % 3] = sign * (2 * static_cast<float>(x) / n - 1);
        position[(axis + 2) % 3] = 2 * static_cast<float>(y) / n - 1;
        normal[axis] = sign;
        mesh.positions.push_back(position);
        mesh.normals.push_back(normal);
      }
    const auto at = [&](std::uint32_t x, std::uint32_t y) { return first + y * (n + 1) + x; };
    for (std::uint32_t y = 0; y < n; ++y)
      for (std::uint32_t x = 0; x < n; ++x) {
        addTriangle(mesh, at(x, y), at(x + 1, y), at(x + 1, y + 1));
        addTriangle(mesh, at(x, y), at(x + 1, y + 1), at(x, y + 1));
      }
  }
  addPlainWedges(mesh);
  const BuiltLevels built = build(mesh, 500, 10);
  ASSERT_GE(built.levelCount(), 3u);
  for (const GroupMesh& group : built.meshes)
    for (const Vec3f& normal : group.patch.normals)
      EXPECT_GT(std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)}), 0.95f);
  expectClosedCuts(built, 5);
}

TEST(Levels, KeepTextureCoordinatesAndColours) {
  Mesh mesh = torus(60, 60);
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const float y = mesh.positions[mesh.wedgePositions[wedge]].y;
    mesh.colors.push_back(y > 0 ? Rgba{1, 0, 0, 1} : Rgba{0, 0, 1, 1});
  }
  const BuiltLevels built = build(mesh, 1000);
  ASSERT_GE(built.levelCount(), 2u);
  const Patch& root = built.meshes.front().patch;
  ASSERT_EQ(root.texCoords.size(), root.wedgeCount());
  ASSERT_EQ(root.colors.size(), root.wedgeCount());
  const auto [low, high] = std::ranges::minmax_element(root.texCoords, {}, [](const Vec2f& t) { return t.x; });
  EXPECT_LT(low->x, 0.1f);
  EXPECT_GT(high->x, 0.9f);
  for (std::size_t corner = 0; corner < root.corners.size(); corner += 3)
    for (std::size_t i = 0; i < 3; ++i) // no triangle is stretched over the seam
      EXPECT_LT(
          std::abs(root.texCoords[root.corners[corner + i]].x - root.texCoords[root.corners[corner + (i + 1) % 3]].x),
          0.5f);
}

} // namespace
} // namespace imgeo
