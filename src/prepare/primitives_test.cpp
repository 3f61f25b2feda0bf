#include "prepare/primitives.h"

#include "base/soak_testing.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <array>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A corner: its position and its attributes.
using Corner = std::array<double, 12>;
using Triangle = std::array<Corner, 3>;

template <typename Piece> Corner cornerOf(const Piece& piece, std::uint32_t wedge, Vec3u position) {
  Corner c{double(position.x), double(position.y), double(position.z)};
  if (!piece.normals.empty())
    c[3] = piece.normals[wedge].x, c[4] = piece.normals[wedge].y, c[5] = piece.normals[wedge].z;
  if (!piece.texCoords.empty())
    c[6] = piece.texCoords[wedge].x, c[7] = piece.texCoords[wedge].y;
  if (!piece.colors.empty())
    c[8] = piece.colors[wedge].r, c[9] = piece.colors[wedge].g, c[10] = piece.colors[wedge].b,
    c[11] = piece.colors[wedge].a;
  return c;
}

/// The triangle with its corners rotated so that the minimum comes first.
Triangle turned(Triangle t) {
  return std::min({t, Triangle{t[1], t[2], t[0]}, Triangle{t[2], t[0], t[1]}});
}

enum class Degenerate { kept, dropped };

std::vector<Triangle> trianglesIn(const Patch& patch, Degenerate degenerate) {
  std::vector<Triangle> result;
  for (std::size_t i = 0; i < patch.corners.size(); i += 3) {
    const std::uint32_t* w = &patch.corners[i];
    if (degenerate == Degenerate::dropped && (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]))
      continue;
    Triangle t;
    for (std::size_t j = 0; j < 3; ++j)
      t[j] = cornerOf(patch, w[j], patch.positions[patch.wedgePositions[w[j]]]);
    result.push_back(turned(t));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Triangle> trianglesIn(const IndexedPatch& patch) {
  std::vector<Triangle> result;
  for (const Vec3u& drawn : trianglesOf(patch)) {
    Triangle t;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::uint32_t vertex = drawn[static_cast<int>(j)];
      t[j] = cornerOf(patch, vertex, patch.positions[vertex]);
    }
    result.push_back(turned(t));
  }
  std::sort(result.begin(), result.end());
  return result;
}

Patch patchOf(Mesh mesh) {
  weld(mesh);
  return cutIntoPatches(mesh, latticeFor(boxOf(mesh), 20), 65535).patches.at(0);
}

/// Random triangles between `vertices` vertices, with hardly a manifold edge among them.
Patch tangle(std::uint32_t triangles, std::uint32_t vertices, std::uint32_t seed) {
  testing::Random random(seed);
  Mesh mesh;
  for (std::uint32_t i = 0; i < vertices; ++i)
    mesh.positions.push_back(random.point());
  testing::addPlainWedges(mesh);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const std::uint32_t a = random.below(vertices), b = random.below(vertices), c = random.below(vertices);
    testing::addTriangle(mesh, a, b, c);
  }
  return patchOf(mesh);
}

/// A closed fan of `count` triangles around a vertex.
Patch wheel(std::uint32_t count) {
  Mesh mesh;
  mesh.positions.push_back({0, 0, 1});
  for (std::uint32_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    mesh.positions.push_back(Vec3f(Vec3d{std::cos(angle), std::sin(angle), 0}));
    testing::addTriangle(mesh, 0, 1 + i, 1 + (i + 1) % count);
  }
  testing::addPlainWedges(mesh);
  return cutIntoPatches(mesh, latticeFor(boxOf(mesh), 24), 65535).patches.at(0);
}

std::vector<Patch> everyKindOfPatch() {
  std::vector<Patch> patches;
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    const Mesh mesh = testing::randomMesh(seed);
    if (mesh.topology == Topology::triangles)
      patches.push_back(patchOf(mesh));
  }
  for (std::uint32_t seed = 0; seed < 200; ++seed)
    patches.push_back(tangle(1 + seed, 2 + seed % 40, seed));
  patches.push_back(wheel(60000));
  patches.push_back(patchOf(testing::sphere(60, 60)));
  return patches;
}

void expectWhole(const IndexedPatch& result) {
  std::size_t drawn = 0;
  for (const Draw& draw : result.draws)
    drawn += draw.count;
  ASSERT_EQ(drawn, result.indices.empty() ? result.vertexCount() : result.indices.size());
  for (const std::uint32_t index : result.indices)
    ASSERT_LT(index, result.vertexCount());
  for (const std::size_t size : {result.normals.size(), result.texCoords.size(), result.colors.size()})
    ASSERT_TRUE(size == 0 || size == result.vertexCount());
}

void expectNumberedByFirstUse(const IndexedPatch& result) {
  std::uint32_t used = 0;
  for (const std::uint32_t index : result.indices) {
    ASSERT_LE(index, used);
    used = std::max(used, index + 1);
  }
  ASSERT_EQ(used, result.vertexCount());
}

TEST(Triangles, AreTheTrianglesOfThePatch) {
  for (const Patch& patch : everyKindOfPatch()) {
    const IndexedPatch result = asTriangles(patch);
    expectWhole(result);
    expectNumberedByFirstUse(result);
    EXPECT_EQ(result.vertexCount(), patch.wedgeCount());
    EXPECT_EQ(result.indices.size(), patch.corners.size()); // degenerate ones are kept
    EXPECT_TRUE(trianglesIn(result) == trianglesIn(patch, Degenerate::dropped));
  }
}

TEST(Triangles, AreGroupedIntoFansOfTheirFirstVertex) {
  const IndexedPatch result = asTriangles(patchOf(testing::sphere(20, 30)));
  for (std::size_t i = 3; i < result.indices.size(); i += 3)
    EXPECT_LE(result.indices[i - 3], result.indices[i]);
}

TEST(Strips, DrawThePatchsTriangles) {
  for (int effort = 0; const Patch& patch : everyKindOfPatch()) {
    const IndexedPatch result = asStrips(patch, effort++ % 10);
    expectWhole(result);
    expectNumberedByFirstUse(result);
    EXPECT_TRUE(trianglesIn(result) == trianglesIn(patch, Degenerate::dropped));
    EXPECT_LE(result.draws.size(), 2u);
  }
}

/// Triangles whose corners have three different positions; without indices the others look like the strip's joins.
std::vector<Triangle> withArea(std::vector<Triangle> triangles) {
  std::erase_if(triangles, [](const Triangle& t) {
    const auto haveEqualPositions = [](const Corner& a, const Corner& b) {
      return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
    };
    return haveEqualPositions(t[0], t[1]) || haveEqualPositions(t[1], t[2]) || haveEqualPositions(t[2], t[0]);
  });
  return triangles;
}

TEST(WithoutIndices, TheTrianglesAreTheSame) {
  for (const Patch& patch : everyKindOfPatch()) {
    const std::vector<Triangle> expected = withArea(trianglesIn(patch, Degenerate::dropped));
    for (const IndexedPatch& arranged : {asTriangles(patch), asStrips(patch, 0)}) {
      const IndexedPatch result = withoutIndices(arranged);
      expectWhole(result);
      EXPECT_TRUE(result.indices.empty());
      EXPECT_EQ(result.vertexCount(), arranged.indices.size());
      EXPECT_TRUE(trianglesIn(result) == expected);
    }
  }
}

TEST(Strips, TakeFewerIndicesThanTriangles) {
  for (const Patch& patch : {patchOf(testing::grid(50)), patchOf(testing::sphere(50, 50))}) {
    const auto perTriangle = [&](int effort) {
      return static_cast<double>(asStrips(patch, effort).indices.size()) / static_cast<double>(patch.elementCount());
    };
    EXPECT_LE(perTriangle(9), perTriangle(5));
    EXPECT_LT(perTriangle(5), 1.2);
    EXPECT_LT(perTriangle(5), perTriangle(0));
    EXPECT_LT(perTriangle(0), 1.3);
  }
}

SOAK_TEST(Strips, AreCloseToTheMinimumNumberOfIndices) {
  // A strip has at least v / 3 indices of a vertex of valence v: docs/decisions/strips.md.
  for (const Patch& patch : {patchOf(testing::grid(80)), patchOf(testing::torus(100, 60))}) {
    const IndexedPatch strips = asStrips(patch, 9);
    EXPECT_LT(static_cast<double>(strips.indices.size()), 1.08 * static_cast<double>(patch.elementCount()));
  }
}

TEST(Strips, LeaveManySeparateTrianglesToADrawOfTheirOwn) {
  const auto joined = [](std::uint32_t loose) {
    Mesh mesh = testing::grid(10);
    for (std::uint32_t i = 0; i < loose; ++i) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (float corner = 0; corner < 3; ++corner)
        mesh.positions.push_back({3 + corner, static_cast<float>(i), corner * corner});
      testing::addTriangle(mesh, first, first + 1, first + 2);
    }
    testing::addPlainWedges(mesh);
    return asStrips(patchOf(mesh), 9);
  };
  const IndexedPatch few = joined(5), many = joined(500);
  ASSERT_EQ(few.draws.size(), 1u);
  ASSERT_EQ(many.draws.size(), 2u);
  EXPECT_EQ(many.draws[0].primitive, Primitive::triangleStrip);
  EXPECT_EQ(many.draws[1], (Draw{Primitive::triangles, 1500}));
}

TEST(Strips, AreTrianglesIfAllTrianglesAreDegenerate) {
  Mesh mesh = testing::grid(1);
  mesh.corners = {0, 1, 1, 2, 2, 3};
  const Patch patch = patchOf(mesh);
  const IndexedPatch result = asStrips(patch, 9);
  expectWhole(result);
  EXPECT_GT(result.vertexCount(), 0u);
  EXPECT_TRUE(trianglesOf(result).empty());
}

using Line = std::array<Corner, 2>;

Line turned(Line line) {
  return std::min(line, Line{line[1], line[0]});
}

std::vector<Line> linesIn(const Patch& patch) {
  std::vector<Line> result;
  for (std::size_t i = 0; i < patch.corners.size(); i += 2) {
    const std::uint32_t a = patch.corners[i], b = patch.corners[i + 1];
    if (a != b)
      result.push_back(turned(Line{cornerOf(patch, a, patch.positions[patch.wedgePositions[a]]),
                                   cornerOf(patch, b, patch.positions[patch.wedgePositions[b]])}));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<Line> linesIn(const IndexedPatch& patch) {
  std::vector<Line> result;
  for (const Vec2<std::uint32_t>& line : linesOf(patch))
    result.push_back(turned(
        Line{cornerOf(patch, line.x, patch.positions[line.x]), cornerOf(patch, line.y, patch.positions[line.y])}));
  std::sort(result.begin(), result.end());
  return result;
}

TEST(Lines, AreTheLinesOfThePatchWithAndWithoutStripsAndIndices) {
  for (std::uint32_t seed = 0; seed < 300; ++seed) {
    Mesh mesh = testing::polylines(1 + seed % 40, seed);
    for (std::uint32_t& corner : mesh.corners)
      if (seed % 3 == 0 && corner % 5 == 0) { // positions of several wedges
        mesh.wedgePositions.push_back(mesh.wedgePositions[corner]);
        corner = static_cast<std::uint32_t>(mesh.wedgeCount() - 1);
      }
    if (seed % 2)
      for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
        mesh.texCoords.push_back({static_cast<float>(wedge), 0});
    const Patch patch = patchOf(mesh);
    std::vector<Line> expected = linesIn(patch), withLength = expected;
    std::erase_if(withLength, [](const Line& line) { return std::equal(&line[0][0], &line[0][3], &line[1][0]); });
    for (const IndexedPatch& result : {asLines(patch), asLineStrips(patch)}) {
      expectWhole(result);
      expectNumberedByFirstUse(result);
      EXPECT_TRUE(linesIn(result) == expected) << seed;
      EXPECT_TRUE(linesIn(withoutIndices(result)) == withLength) << seed;
    }
  }
}

TEST(LineStrips, TakeFewerIndicesThanLinesInFewDraws) {
  Mesh mesh = testing::polylines(0, 1);
  mesh.corners.clear(), mesh.positions.clear(), mesh.wedgePositions.clear();
  for (std::uint32_t i = 0; i < 10000; ++i) { // one long line, and many of two vertices
    mesh.positions.push_back({static_cast<float>(i), 0, 0});
    if (i % 10000 > 0 && (i < 5000 || i % 2 == 1))
      mesh.corners.insert(mesh.corners.end(), {i - 1, i});
  }
  testing::addPlainWedges(mesh);
  const Patch patch = patchOf(mesh);
  const IndexedPatch strips = asLineStrips(patch);
  EXPECT_EQ(asLines(patch).indices.size(), 2 * patch.elementCount());
  EXPECT_EQ(strips.indices.size(), 5000 + 5000);
  EXPECT_EQ(strips.draws, (std::vector<Draw>{{Primitive::lineStrip, 5000}, {Primitive::lines, 5000}}));
  std::size_t drawn = 0;
  for (const Draw& draw : strips.draws)
    drawn += elementsOf(draw).lines;
  EXPECT_EQ(drawn, patch.elementCount());
}

TEST(Points, AreEveryWedgeOnce) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const Patch patch = patchOf(testing::randomMesh(seed));
    const IndexedPatch result = asPoints(patch);
    expectWhole(result);
    EXPECT_TRUE(result.indices.empty());
    std::vector<Corner> expected, found;
    for (std::uint32_t i = 0; i < patch.wedgeCount(); ++i) {
      expected.push_back(cornerOf(patch, i, patch.positions[patch.wedgePositions[i]]));
      found.push_back(cornerOf(result, i, result.positions[i]));
    }
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    EXPECT_TRUE(found == expected) << seed;
  }
}

TEST(Points, ComeInMortonOrder) {
  Patch patch;
  patch.topology = Topology::points;
  testing::Random random(1);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    patch.positions.push_back({random.bits() >> random.below(32), random.bits(), random.bits() >> random.below(32)});
    patch.wedgePositions.push_back(i);
    patch.corners.push_back(i);
  }
  const auto code = [](Vec3u p) {
    std::array<std::uint32_t, 3> words{}; // 96 interleaved bits, the highest first; x above y above z
    for (std::uint32_t i = 0; i < 96; ++i) {
      const std::uint32_t bit = p[static_cast<int>(i % 3)] >> (31 - i / 3) & 1;
      words[i / 32] |= bit << (31 - i % 32);
    }
    return words;
  };
  const IndexedPatch result = asPoints(patch);
  for (std::size_t i = 1; i < result.vertexCount(); ++i)
    EXPECT_LE(code(result.positions[i - 1]), code(result.positions[i]));
}

TEST(TrianglesOf, AreThoseOfFansAndHaveTheirFrontWhereTheDrawsHaveIt) {
  IndexedPatch patch;
  patch.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  patch.draws = {{Primitive::triangleFan, 4}};
  EXPECT_EQ(trianglesOf(patch), (std::vector<Vec3u>{{0, 1, 2}, {0, 2, 3}}));
  patch.ccw = false;
  EXPECT_EQ(trianglesOf(patch), (std::vector<Vec3u>{{0, 2, 1}, {0, 3, 2}}));
}

TEST(LinesOf, CloseALoop) {
  IndexedPatch patch;
  patch.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  patch.draws = {{Primitive::lineLoop, 3}};
  EXPECT_EQ(linesOf(patch), (std::vector<Vec2<std::uint32_t>>{{0, 1}, {1, 2}, {2, 0}}));
  EXPECT_EQ(elementsOf(patch.draws[0]).lines, 3u);
}

TEST(TrianglesOf, ReversesEverySecondTriangleOfAStripAndRestartsWithEachDraw) {
  IndexedPatch patch;
  patch.positions.resize(6);
  patch.draws = {{Primitive::triangleStrip, 5}, {Primitive::triangles, 3}, {Primitive::triangleStrip, 3}};
  patch.indices = {0, 1, 2, 3, 3, 5, 4, 3, 2, 1, 0};
  EXPECT_EQ(trianglesOf(patch), (std::vector<Vec3u>{{0, 1, 2}, {2, 1, 3}, {5, 4, 3}, {2, 1, 0}}));
  patch.indices.clear();
  patch.draws = {{Primitive::triangles, 6}};
  EXPECT_TRUE(trianglesOf(patch).empty()); // all positions are equal
  for (std::uint32_t i = 0; i < 6; ++i)
    patch.positions[i].x = i;
  EXPECT_EQ(trianglesOf(patch), (std::vector<Vec3u>{{0, 1, 2}, {3, 4, 5}}));
}

} // namespace
} // namespace imgeo
