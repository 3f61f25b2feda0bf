#include "prepare/sharp_edges.h"

#include "prepare/boxes_testing.h"
#include "prepare/weld.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

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
