#include "prepare/height_field.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A grid of 4 x 3 vertices, numbered from the lower right one.
Mesh hills() {
  Mesh mesh;
  for (int n = 11; n >= 0; --n)
    mesh.positions.push_back({0.1f * static_cast<float>(n % 4), static_cast<float>(n * n % 7),
                              5 + 0.3f * static_cast<float>(n / 4)}); // NOLINT: whole rows
  for (std::uint32_t n = 0; n < 12; ++n)
    mesh.wedgePositions.push_back(n);
  for (std::uint32_t row = 0; row < 2; ++row)
    for (std::uint32_t column = 0; column < 3; ++column) {
      const std::uint32_t here = 4 * row + column;
      for (const std::uint32_t n : {here, here + 4, here + 1, here + 5, here + 1, here + 4})
        mesh.corners.push_back(11 - n);
    }
  return mesh;
}

std::string lackOf(const Mesh& mesh) {
  const auto found = heightFieldOf(mesh);
  const auto* lack = std::get_if<std::string>(&found);
  return lack ? *lack : "";
}

TEST(HeightField, IsFoundWhateverTheOrderOfVerticesAndTriangles) {
  const Mesh mesh = hills();
  const HeightField field = std::get<HeightField>(heightFieldOf(mesh));
  EXPECT_EQ(field.columns, 4u);
  EXPECT_EQ(field.rows, 3u);
  for (std::uint32_t n = 0; n < 12; ++n)
    EXPECT_EQ(field.wedges[n], 11 - n);
}

TEST(HeightField, IsNoOtherSurface) {
  Mesh mesh = hills();
  mesh.positions[3].x += 0.04f;
  EXPECT_EQ(lackOf(mesh), "its vertices are on no regular grid along x and z");
  mesh = hills();
  mesh.positions.pop_back();
  mesh.wedgePositions.pop_back();
  mesh.corners.resize(9);
  EXPECT_EQ(lackOf(mesh), "its grid has holes");
  mesh = hills();
  mesh.positions[0] = mesh.positions[1];
  mesh.positions[0].y += 1;
  EXPECT_EQ(lackOf(mesh), "two of its vertices are above one another");
  mesh = hills();
  mesh.corners.resize(mesh.corners.size() - 3);
  EXPECT_NE(lackOf(mesh), "");
  mesh = hills();
  std::swap(mesh.corners[0], mesh.corners[1]); // seen from below
  EXPECT_NE(lackOf(mesh), "");
  mesh = hills();
  mesh.topology = Topology::points;
  EXPECT_EQ(lackOf(mesh), "it has no triangles");
}

} // namespace
} // namespace imgeo
