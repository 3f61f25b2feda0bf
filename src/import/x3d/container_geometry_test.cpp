#include "import/x3d/container_geometry.h"

#include "base/data_url.h"
#include "containers/compact/patch_coding.h"
#include "containers/compact/payload_image.h"
#include "import/testing.h"

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>

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

TEST(ContainerGeometry, MayBeCompactOfOneToThirtyBitsACoordinate) {
  for (const std::uint32_t bits : {1, 2, 7, 8, 9, 30}) {
    SCOPED_TRACE(bits);
    compact::CompactPatch patch;
    patch.positionBits = bits;
    const std::uint32_t last = (1u << bits) - 1;
    patch.positions = {{0, 0, 0}, {last, 0, 0}, {0, last, 0}};
    patch.wedgePositions = patch.corners = {0, 1, 2};
    const Bytes file = compact::imageOfPayload(compact::encodePatches(std::array{patch}, 0).bytes);
    const Imported imported =
        importBytes(asBytes(fmt::format("<X3D><Scene><Shape><ImageGeometry profile='compact' size='2 2 2' "
                                        "positionBits='{}' vertexCount='3' data='{}'/></Shape></Scene></X3D>",
                                        bits, dataUrlOf(file, "image/png"))),
                    "old.x3d");
    EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
    ASSERT_EQ(imported.scene.meshes.size(), 1u);
    // Lattice points are the upper bits of whole bytes, which are spread over the box.
    const std::uint32_t stored = 8 * ((bits + 7) / 8);
    const double largest =
        -1 + 2 * std::ldexp(last, static_cast<int>(stored - bits)) / (std::ldexp(1, static_cast<int>(stored)) - 1);
    Box3d box;
    for (const Vec3f& position : imported.scene.meshes[0].positions)
      box.add(Vec3d(position));
    EXPECT_LT(length(box.min - Vec3d{-1, -1, -1}), 1e-6);
    EXPECT_LT(length(box.max - Vec3d{largest, largest, -1}), 1e-6);
  }
}

TEST(ContainerGeometry, MayHaveFloatsOutsideOfItsBox) {
  // X3DOM does not use the box of floats, so that authors leave it out: its default is -1 .. 1.
  const std::string coord = urlOf<float>({0, 0, 0, 100, 0, 0, 0, 7.5F, 0});
  for (const std::string box : {"", "position='5000 0 0' size='1 1 1'", "size='1e-6 1e-6 1e-6'"}) {
    const Imported imported = importBytes(
        asBytes(fmt::format("<X3D><Scene><Shape><BinaryGeometry {} vertexCount='3' coord='{}'/></Shape></Scene></X3D>",
                            box, coord)),
        "old.x3d");
    EXPECT_TRUE(imported.warnings.empty()) << box << ::testing::PrintToString(imported.warnings);
    ASSERT_EQ(imported.scene.meshes.size(), 1u) << box;
    const Mesh& mesh = imported.scene.meshes[0];
    EXPECT_LT(length(Vec3d(mesh.cornerPosition(1)) - Vec3d{100, 0, 0}), 1e-6) << box;
    EXPECT_LT(length(Vec3d(mesh.cornerPosition(2)) - Vec3d{0, 7.5, 0}), 1e-6) << box;
  }
}

TEST(ContainerGeometry, IsRefusedWithFloatsThatAreNoNumbers) {
  const std::string coord = urlOf<float>({0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0, 0, 1, 0});
  const Imported imported = importBytes(asBytes("<X3D><Scene><Shape><Box/></Shape><Shape><BinaryGeometry "
                                                "vertexCount='3' coord='" +
                                                coord + "'/></Shape></Scene></X3D>"),
                                        "old.x3d");
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("a coordinate is not a number"), std::string::npos) << imported.warnings[0];
}

} // namespace
} // namespace imgeo::x3d::testing
