#include "prepare/sharp_edges.h"

#include "prepare/boxes_testing.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <utility>

namespace imgeo {
namespace {

/// A prism with two caps, which are fans around their centres.
Mesh prism(std::uint32_t sides) {
  Mesh mesh;
  for (const float y : {0.f, 1.f}) {
    mesh.positions.push_back({0, y, 0});
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle = 2 * std::numbers::pi * i / sides;
      mesh.positions.push_back({static_cast<float>(std::cos(angle)), y, static_cast<float>(std::sin(angle))});
    }
  }
  testing::addPlainWedges(mesh);
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t a = 1 + i, b = 1 + (i + 1) % sides, above = sides + 1;
    testing::addTriangle(mesh, 0, a, b);
    testing::addTriangle(mesh, above, above + b, above + a);
    testing::addTriangle(mesh, a, above + a, b);
    testing::addTriangle(mesh, b, above + a, above + b);
  }
  return mesh;
}

Mesh roughTorus(double roughness) {
  Mesh mesh = testing::torus(150, 80);
  mesh.normals.clear(), mesh.texCoords.clear();
  testing::Random random(5);
  for (Vec3f& position : mesh.positions)
    position += random.point() * static_cast<float>(roughness);
  weld(mesh);
  return mesh;
}

TEST(SharpEdges, AreThoseOfBoxesAndPrisms) {
  EXPECT_TRUE(isManMade(testing::boxes(1)));
  EXPECT_TRUE(isManMade(testing::boxes(5000)));
  for (const std::uint32_t sides : {3u, 8u, 36u, 60u})
    EXPECT_TRUE(isManMade(prism(sides))) << sides;
}

TEST(SharpEdges, AreNotThoseOfSmoothOrRoughSurfaces) {
  for (const double roughness : {0.0, 0.002, 0.01, 0.05, 0.5})
    EXPECT_FALSE(isManMade(roughTorus(roughness))) << roughness;
  Mesh plane = testing::grid(20);
  EXPECT_FALSE(isManMade(plane)) << "has no edges that creases would divide";
}

TEST(SharpEdges, AreThoseOfFacesAt45DegreesAndNotThoseOfFinerFacets) {
  const auto tube = [](std::uint32_t sides) { // a prism without its caps
    Mesh mesh = prism(sides);
    std::vector<std::uint32_t> corners;
    for (std::uint32_t side = 0; side < sides; ++side)
      corners.insert(corners.end(), &mesh.corners[12 * side + 6], &mesh.corners[12 * side] + 12);
    mesh.corners = corners;
    return mesh;
  };
  EXPECT_TRUE(isManMade(tube(8)));
  EXPECT_FALSE(isManMade(tube(10)));
  EXPECT_FALSE(isManMade(tube(60)));
}

TEST(SharpEdges, AreThoseOfSolidsOfTriangles) {
  Mesh octahedron;
  octahedron.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  testing::addPlainWedges(octahedron);
  for (const std::uint32_t x : {0u, 1u})
    for (const std::uint32_t y : {2u, 3u})
      for (const std::uint32_t z : {4u, 5u})
        testing::addTriangle(octahedron, x, (x + y + z) % 2 == 0 ? y : z, (x + y + z) % 2 == 0 ? z : y);
  EXPECT_TRUE(isManMade(octahedron));
}

/// The pieces of a mesh of so many triangles each.
std::vector<Mesh> piecesOf(const Mesh& mesh, std::size_t triangles) {
  std::vector<Mesh> pieces;
  for (std::size_t begin = 0; begin < mesh.corners.size(); begin += 3 * triangles) {
    Mesh& piece = pieces.emplace_back();
    for (std::size_t corner = begin; corner < std::min(begin + 3 * triangles, mesh.corners.size()); ++corner)
      piece.positions.push_back(mesh.cornerPosition(corner) + Vec3f{-0.0f, -0.0f, -0.0f});
    testing::addPlainWedges(piece);
    piece.corners = piece.wedgePositions;
  }
  return pieces;
}

TEST(SharpEdges, AreThoseOfAllPiecesTogetherInAnyOrder) {
  for (const auto& [mesh, manMade] : {std::pair(testing::boxes(5000), true), {roughTorus(0.01), false}}) {
    std::vector<CornerTriangle> whole = sampledCorners(mesh, mesh.elementCount());
    EXPECT_LT(whole.size(), mesh.corners.size() * 2 / 3);
    EXPECT_GT(whole.size(), 10000u);
    std::vector<Mesh> pieces = piecesOf(mesh, 777);
    std::ranges::reverse(pieces);
    std::vector<CornerTriangle> corners;
    for (const Mesh& piece : pieces)
      appendSampledCorners(corners, sampledCorners(piece, mesh.elementCount()));
    EXPECT_EQ(isManMade(corners), manMade);
    EXPECT_EQ(isManMade(mesh), manMade);
    const auto key = [](const CornerTriangle& corner) {
      std::array<float, 9> values{};
      for (std::size_t i = 0; i < 9; ++i)
        values[i] = corner[i / 3][static_cast<int>(i % 3)];
      return values;
    };
    std::ranges::sort(whole, {}, key), std::ranges::sort(corners, {}, key);
    EXPECT_EQ(corners, whole);
  }
}

TEST(SharpEdges, AreNotThoseOfMillionsOfTrianglesAroundOneVertex) {
  Mesh mesh = testing::boxes(1);
  for (std::uint32_t i = 0; i < 300000; ++i)
    testing::addTriangle(mesh, 0, 1, 2);
  EXPECT_LT(sampledCorners(mesh, 1).size(), std::size_t{1} << 19);
  EXPECT_FALSE(isManMade(sampledCorners(mesh, 1)));
}

TEST(SharpEdges, AreNotThoseOfMeshesWithoutEdges) {
  EXPECT_FALSE(isManMade(Mesh()));
  Mesh triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  testing::addPlainWedges(triangle);
  testing::addTriangle(triangle, 0, 1, 2);
  EXPECT_FALSE(isManMade(triangle));
}

} // namespace
} // namespace imgeo
