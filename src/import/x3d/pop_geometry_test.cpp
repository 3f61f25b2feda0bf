#include "import/x3d/pop_geometry.h"

#include "base/bytes.h"
#include "import/testing.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <initializer_list>

namespace imgeo::x3d::testing {
namespace {

struct Vertex {
  std::initializer_list<std::uint16_t> position; ///< and, as a fourth number, a spherical normal
  std::initializer_list<std::uint8_t> normal, color;
  std::initializer_list<std::uint16_t> texCoord;
};

// A rectangle that reaches into the second cell of the grid in x.
const Vertex first{{39321, 0, 0, 0xff00}, {0, 0, 255}, {255, 0, 51}, {0, 0}};
const Vertex second{{13107, 0, 0, 0xff00}, {0, 0, 255}, {255, 255, 51}, {65535, 0}};
const Vertex third{{13107, 65535, 65535, 0}, {255, 0, 0}, {0, 255, 51}, {65535, 65535}};
const Vertex fourth{{39321, 65535, 65535, 0}, {255, 0, 0}, {0, 0, 0}, {0, 65535}};

/// A level's file, as a url: its indices, then its vertices, of 22 bytes each.
std::string file(std::initializer_list<std::uint16_t> indices, std::initializer_list<Vertex> vertices) {
  Bytes bytes;
  for (const std::uint16_t index : indices)
    appendLittle(bytes, index);
  for (const Vertex& vertex : vertices) {
    for (const std::uint16_t value : vertex.position)
      appendLittle(bytes, value);
    bytes.insert(bytes.end(), vertex.normal);
    bytes.push_back(0);
    for (const std::uint16_t value : vertex.texCoord)
      appendLittle(bytes, value);
    bytes.insert(bytes.end(), vertex.color);
    bytes.insert(bytes.end(), 3, 0);
  }
  std::string url = "data:application/octet-stream,";
  for (const std::uint8_t byte : bytes)
    url += fmt::format("%{:02x}", byte);
  return url;
}

std::string level(const std::string& src, std::uint32_t indices, std::uint32_t firstVertex) {
  return fmt::format("<PopGeometryLevel src='{}' numIndices='{}' vertexDataBufferOffset='{}'></PopGeometryLevel>", src,
                     indices, firstVertex);
}

std::string document(const std::string& fields, const std::string& levels) {
  return "<X3D><Scene><Shape><PopGeometry attributeStride='22' size='4 4 2' tightSize='3 4 2' bbMin='6 0 -1' "
         "bbMinModF='0.6 0 0' bbMaxModF='0.2 1 1' " +
         fields + ">" + levels + "</PopGeometry></Shape><Shape><Box/></Shape></Scene></X3D>";
}

const std::string attributes = "normalOffset='8' texcoordOffset='12' colorOffset='16' ";
const std::string twoLevels =
    level(file({0, 1, 2}, {first, second, third}), 3, 0) + level(file({0, 2, 3}, {fourth}), 3, 3);

std::vector<Vec3f> cornersOf(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    corners.push_back(mesh.cornerPosition(corner));
  return corners;
}

const std::vector<Vec3f> rectangle{{6.4f, 0, -2}, {8.8f, 0, -2}, {8.8f, 4, 0},
                                   {6.4f, 0, -2}, {8.8f, 4, 0},  {6.4f, 4, 0}};

void expectRectangle(const Mesh& mesh) {
  const std::vector<Vec3f> corners = cornersOf(mesh);
  ASSERT_EQ(corners.size(), rectangle.size());
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_LT(length(Vec3d(corners[i]) - Vec3d(rectangle[i])), 1e-6) << i;
}

TEST(PopGeometry, JoinsItsLevelsAtFullPrecision) {
  const Mesh mesh = imgeo::testing::onlyMesh(
      document("vertexCount='6' primType='\"TRIANGLES\"' vertexBufferSize='4' " + attributes, twoLevels), "pop.x3d");
  expectRectangle(mesh);
  EXPECT_EQ(mesh.positions.size(), 4u);
  const std::vector<std::uint32_t>& corners = mesh.corners;
  EXPECT_LT(length(Vec3d(mesh.normals.at(corners[1])) - Vec3d{-1, -1, 1} * (1 / std::sqrt(3))), 1e-6);
  EXPECT_LT(length(Vec3d(mesh.normals.at(corners[5])) - Vec3d{1, -1, -1} * (1 / std::sqrt(3))), 1e-6);
  EXPECT_EQ(mesh.texCoords.at(corners[1]), (Vec2f{1, 0}));
  EXPECT_EQ(mesh.texCoords.at(corners[5]), (Vec2f{0, 1}));
  EXPECT_EQ(asRgba8(mesh.colors.at(corners[1])), (Rgba8{255, 255, 51, 255}));
  EXPECT_EQ(asRgba8(mesh.colors.at(corners[5])), (Rgba8{0, 0, 0, 255}));
}

TEST(PopGeometry, JoinsVerticesByTheirOffsetsAndWithoutIndicesByTheirOrder) {
  const std::string swapped = level(file({}, {fourth}), 0, 3) +
                              level(file({0, 1, 2, 0, 2, 3}, {first, second, third}), 6, 0) + level("data:,", 0, 99);
  expectRectangle(imgeo::testing::onlyMesh(document("", swapped), "pop.x3d"));
  const std::string inOrder =
      level(file({}, {first, second, third}), 0, 0) + level(file({}, {first, third, fourth}), 0, 0);
  const Mesh mesh = imgeo::testing::onlyMesh(document("indexedRendering='false'", inOrder), "pop.x3d");
  expectRectangle(mesh);
  EXPECT_TRUE(mesh.normals.empty() && mesh.texCoords.empty() && mesh.colors.empty());
}

TEST(PopGeometry, ReadsSphericalNormalsFromTheFourthCoordinate) {
  const Mesh mesh = imgeo::testing::onlyMesh(document("sphericalNormals='true'", twoLevels), "pop.x3d");
  expectRectangle(mesh);
  EXPECT_LT(length(Vec3d(mesh.normals.at(mesh.corners[1])) - Vec3d{0, 0, -1}), 1e-6);
  EXPECT_LT(length(Vec3d(mesh.normals.at(mesh.corners[5])) - Vec3d{0, 0, 1}), 1e-6);
}

TEST(PopGeometry, IsReadFromAPageWhoseNamesHaveLostTheirCase) {
  std::string page = document(attributes, twoLevels);
  std::ranges::transform(page, page.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  expectRectangle(imgeo::testing::onlyMesh("<!doctype html><title>Old</title>" + page, "pop.html"));
}

TEST(PopGeometry, IsLeftOutWithOneWarningWhereItsLevelsLieAndRefusedIfStrict) {
  const std::string three = file({0, 1, 2}, {first, second, third}), one = file({0, 2, 3}, {fourth});
  struct Lie {
    std::string fields, levels, message;
  };
  ImportOptions strict;
  strict.strict = true;
  for (const auto& [fields, levels, message] : std::initializer_list<Lie>{
           {"", level(three, 37, 0), "72 bytes, too few for 37"},
           {"", level(three, 4000000000, 0), "too few for 4000000000 indices"},
           {"", level(three, 2, 0), "no whole number of vertices"},
           {"", level(three, 3, 0) + level(one, 3, 2), "overlap or leave a gap"},
           {"", level(three, 3, 0) + level(one, 3, 4294967295), "overlap or leave a gap"},
           {"", level(file({0, 1, 3}, {first, second, third}), 3, 0), "3"},
           {"vertexCount='9'", twoLevels, "too few"},
           {"vertexCount='6 6'  primType='\"TRIANGLES\"'", twoLevels, "primType has 1 of 2 draws"},
           {"vertexBufferSize='3'", twoLevels, "vertexBufferSize is 3"},
           {"", "", "no vertices"},
           {"", level("missing.bin", 3, 0), "missing.bin"},
           {"", level("../outside.bin", 3, 0), "outside"},
           {"", level("https://example.org/a.bin", 3, 0), "https://example.org/a.bin"},
           {"", "<PopGeometryLevel numIndices='3'/>", "has no src"},
           {"colorOffset='20'", twoLevels, "colorOffset 20"},
           {"positionOffset='4294967295'", twoLevels, "positionOffset 4294967295"},
           {"coordType='Uint8'", twoLevels, "coordType \"Uint8\""},
           {"normalType='Int8'", twoLevels, "normalType \"Int8\""},
           {"bbShiftVec='7 0 0'", twoLevels, "bbShiftVec"},
       }) {
    SCOPED_TRACE(message);
    const std::string text = document(fields, levels);
    const Imported imported = importBytes(asBytes(text), "pop.x3d");
    EXPECT_TRUE(imported.scene.meshes.empty());
    ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
    EXPECT_TRUE(imported.warnings[0].starts_with("pop.x3d:1:")) << imported.warnings[0];
    EXPECT_NE(imported.warnings[0].find("PopGeometry left out: "), std::string::npos) << imported.warnings[0];
    EXPECT_NE(imported.warnings[0].find(message), std::string::npos) << imported.warnings[0];
    const Error error = imgeo::testing::errorOf(text, "pop.x3d", strict);
    EXPECT_NE(error.kind(), ErrorKind::io);
  }
}

TEST(PopGeometry, IsLeftOutWhereItsBoxOrItsNumberOfLevelsIsBeyondTheLimits) {
  std::string many;
  for (int i = 0; i < 17; ++i)
    many += level("data:,", 0, 0);
  const std::string begin = "<X3D><Scene><Shape><PopGeometry attributeStride='22' ";
  for (const std::string& node : {begin + ">" + many, begin + "size='0 0 0'>" + twoLevels,
                                  begin + "bbMin='1e39 0 0'>" + twoLevels, begin + "size='3e38 1 1'>" + twoLevels}) {
    const Imported imported =
        importBytes(asBytes(node + "</PopGeometry></Shape><Shape><Box/></Shape></Scene></X3D>"), "pop.x3d");
    EXPECT_TRUE(imported.scene.meshes.empty());
    EXPECT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
  }
}

} // namespace
} // namespace imgeo::x3d::testing
