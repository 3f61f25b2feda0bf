// Reads geometry nodes of other programs, with defaults, and damaged ones.

#include "documents/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::errorKindOf;
using testing::readBinaryGeometry;

TEST(ReadGeometry, RefusesImagesOfWhichNothingIsDrawn) {
  const auto scene = [](const std::string& geometry) {
    return "<X3D><Scene>\n<Shape>" + geometry + "</Shape></Scene></X3D>";
  };
  for (const std::string geometry :
       {"<ImageGeometry coord='a'/>", "<ImageGeometry coord='a' vertexCount='4294967296'/>",
        "<ImageGeometry coord='a' primType='LINES POINTS' vertexCount='0 0'/>",
        "<ImageGeometry><GeometryPatch coord='a' vertexCount='3'/><GeometryPatch coord='b'/></ImageGeometry>",
        "<BinaryGeometry coord='a' primType='LINES POINTS' vertexCount='0 0'/>"})
    EXPECT_EQ(errorKindOf(scene(geometry), "s.x3d:2"), ErrorKind::malformed) << geometry;
  for (const std::string geometry :
       {"<BinaryGeometry coord='a'/>", "<BinaryGeometry coord='a' vertexCount='0'/>",
        "<ImageGeometry coord='a' primType='LINES POINTS' vertexCount='0 1'/>",
        "<ImageGeometry coord='a' implicitMeshMode='geometryImage' implicitMeshSize='2 2'/>"})
    EXPECT_EQ(readScene(scene(geometry), "s.x3d").geometries.size(), 1u) << geometry;
}

TEST(ReadGeometry, CentresSignedCoordinatesInABoxOfAnyShape) {
  const Lattice lattice = readBinaryGeometry("coordType='Int16' position='1 2 3' size='4 2 0' coord='a'").lattice;
  EXPECT_EQ(lattice.bits, 16u);
  const Vec3d middle = lattice.point({32768, 32768, 32768}), corner = lattice.point({32768 + 32767, 32768 - 32767, 0});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(middle[axis], (Vec3d{1, 2, 3}[axis]), 1e-12);
    EXPECT_NEAR(corner[axis], (Vec3d{5, 0, 3}[axis]), 1e-12);
  }
}

TEST(ReadGeometry, RefusesAttributesThatPatchesLack) {
  const auto messageOf = [](const std::string& attribute, const std::string& attrib) -> std::string {
    const std::string text = "<X3D><Scene><Shape><ImageGeometry coord='a.png' vertexCount='3' attrib='" + attrib +
                             "'><FloatVertexAttribute " + attribute +
                             "></FloatVertexAttribute></ImageGeometry></Shape></Scene></X3D>";
    try {
      readScene(text, "s.x3d");
    } catch (const Error& error) {
      return error.message();
    }
    return "read";
  };
  const std::string good = "name='heat' numComponents='1' valueBits='16'";
  EXPECT_EQ(messageOf(good, "\"b.png\" \"c.png\""), "read");
  EXPECT_NE(messageOf(good, "b.png").find("fewer"), std::string::npos);
  EXPECT_NE(messageOf(good, "\"b\" \"c\" \"d\"").find("more"), std::string::npos);
  EXPECT_NE(messageOf("numComponents='1'", "\"b\" \"c\"").find("no name"), std::string::npos);
  EXPECT_NE(messageOf(good + " valueSize='-1'", "\"b\" \"c\"").find("range"), std::string::npos);
  EXPECT_NE(messageOf("name='heat' numComponents='5'", "b").find("1 to 4"), std::string::npos);
  EXPECT_NE(messageOf("name='heat' numComponents='1' valueBits='12'", "b").find("8, 16"), std::string::npos);
}

TEST(ReadGeometry, UsesX3domsDefaultsForABinaryGeometry) {
  const GeometryDescription geometry = readBinaryGeometry("coord='a' index='i'");
  EXPECT_EQ(geometry.coordType, ElementType::float32);
  EXPECT_EQ(geometry.indexType, ElementType::uint16);
  EXPECT_EQ(geometry.normalEncoding, NormalEncoding::rgb);
  EXPECT_EQ(geometry.patches[0].draws, (std::vector<Draw>{{Primitive::triangles, 0}}));
}

TEST(ReadGeometry, ReadsX3domsSphericalNormalsFromTheFourthElementOfCoordinates) {
  const std::string spherical = " coordType='Uint16' normalAsSphericalCoordinates='true'";
  for (const auto& [coord, normal] : {std::pair{"a.bin", Reference{"a.bin", ByteLocation{6, 8}}},
                                      {"a.bin?+8", {"a.bin", ByteLocation{6, 8}}},
                                      {"a.bin#24+32", {"a.bin", ByteLocation{30, 32}}}}) {
    const GeometryDescription geometry =
        readBinaryGeometry(std::string("normal='ignored' coord='") + coord + "'" + spherical);
    EXPECT_EQ(geometry.normalEncoding, NormalEncoding::spherical);
    EXPECT_EQ(geometry.attributeTypes[VertexRole::normal], ElementType::uint8);
    EXPECT_EQ(geometry.patches[0].vertexAttributes[VertexRole::normal], normal);
  }
  EXPECT_THROW(readBinaryGeometry("coord='a' normalAsSphericalCoordinates='true'"), Error);
}

TEST(ReadGeometry, ReadsIndicesOf16And32BitsFromImages) {
  const auto read = [](const std::string& type) {
    return readScene("<X3D><Scene><Shape><ImageGeometry indexType='" + type +
                         "' coord='a' index='i' vertexCount='3'/></Shape></Scene></X3D>",
                     "x")
        .geometries.at(0)
        .indexType;
  };
  EXPECT_EQ(read(""), ElementType::uint16);
  EXPECT_EQ(read("uint32"), ElementType::uint32);
  EXPECT_THROW(read("Uint8"), Error);
}

TEST(ReadGeometry, RefusesGeometryWithoutALattice) {
  const auto geometry = [](const std::string& fields, const std::string& coord) {
    return "<X3D><Scene><Shape><ImageGeometry vertexCount='3' " + fields + " coord='" + coord +
           "'/></Shape></Scene></X3D>";
  };
  EXPECT_EQ(errorKindOf(geometry("size='1 -2 1'", "a")), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf(geometry("size='0 0 0'", "a")), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf(geometry("positionBits='16'", "a")), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf(geometry("positionBits='7'", "a")), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf(geometry("", "")), ErrorKind::malformed);
}

TEST(ReadGeometry, TakesThePrecisionOfAttributesFromTheirImagesUnlessTheNodeStatesIt) {
  const auto read = [](const std::string& fields) {
    return readScene("<X3D><Scene><Shape><ImageGeometry coord='a' vertexCount='3' " + fields +
                         "/></Shape></Scene></X3D>",
                     "s.x3d")
        .geometries.at(0)
        .imageBits;
  };
  EXPECT_EQ(read("normal='n' texCoord='t' color='c'"), defaultImageBits);
  const auto deep = read(R"(normal='"n" "o"' texCoord='"t" "u"' color='"c" "d" "e"')");
  EXPECT_EQ(deep[VertexRole::normal], 16u);
  EXPECT_EQ(deep[VertexRole::texCoord], 24u);
  EXPECT_EQ(deep[VertexRole::color], 24u);
  EXPECT_EQ(read("normal='n' normalEncoding='spherical'")[VertexRole::normal], 8u);
  EXPECT_EQ(read("normal='n' normalEncoding='spherical' normalBits='16'")[VertexRole::normal], 16u);
  EXPECT_EQ(read("texCoord='t' texCoordBits='8'")[VertexRole::texCoord], 8u);
  for (const char* fields : {"normal='n' normalBits='16'", "normal='n' normalBits='12'",
                             "texCoord='t' texCoordBits='24'", R"(normal='"n" "o"' normalEncoding='octahedral')"})
    EXPECT_EQ(
        errorKindOf(std::string("<X3D><Scene><Shape><ImageGeometry coord='a' ") + fields + "/></Shape></Scene></X3D>"),
        ErrorKind::unsupported)
        << fields;
}

TEST(ReadGeometry, DrawsTrianglesWhereNoKnownPrimTypeIsStated) {
  for (const auto& [fields, draws] : std::initializer_list<std::pair<const char*, std::size_t>>{
           {"primType='QUADS' vertexCount='3'", 1},
           {"primType='TRIANGLES' vertexCount='3 6'", 2},
           {R"(primType='"TRIANGLES" "LINES"' vertexCount='3')", 1}}) {
    const SceneDocument document = readScene(
        std::string("<X3D><Scene><Shape><ImageGeometry coord='a' ") + fields + "/></Shape></Scene></X3D>", "s.x3d");
    const std::vector<Draw>& read = document.geometries.at(0).patches.at(0).draws;
    EXPECT_EQ(read.size(), draws) << fields;
    EXPECT_TRUE(std::ranges::all_of(read, [](const Draw& draw) { return draw.primitive == Primitive::triangles; }));
    EXPECT_EQ(document.warnings.size(), 1u) << fields;
  }
}

} // namespace
} // namespace imgeo
