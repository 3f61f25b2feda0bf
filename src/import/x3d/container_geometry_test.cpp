#include "import/x3d/container_geometry.h"

#include "base/data_url.h"
#include "import/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo::x3d::testing {
namespace {

template <typename Number> std::string urlOf(const std::vector<Number>& numbers) {
  Bytes bytes;
  for (const Number number : numbers)
    appendLittle(bytes, number);
  return dataUrlOf(bytes, "application/octet-stream");
}

TEST(ContainerGeometry, HasTheNormalsOfItsTrianglesWhereTheyAreNotPerVertex) {
  // Two triangles along an edge, at a right angle; the normals of the file are not used.
  const std::string coord = urlOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, -1}),
                    index = urlOf<std::uint16_t>({0, 1, 2, 0, 2, 3}),
                    normal = urlOf<float>({1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
  const Imported imported = importBytes(
      asBytes(fmt::format("<X3D><Scene><Shape><BinaryGeometry vertexCount='6' coord='{}' index='{}' normal='{}' "
                          "normalPerVertex='false'/></Shape></Scene></X3D>",
                          coord, index, normal)),
      "old.x3d");
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  ASSERT_EQ(imported.scene.meshes.size(), 1u);
  const Mesh& mesh = imported.scene.meshes[0];
  ASSERT_EQ(mesh.elementCount(), 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  for (std::size_t corner = 0; corner < 6; ++corner)
    EXPECT_EQ(mesh.normals[mesh.corners[corner]], (corner < 3 ? Vec3f{0, 0, 1} : Vec3f{-1, 0, 0})) << corner;
}

} // namespace
} // namespace imgeo::x3d::testing
