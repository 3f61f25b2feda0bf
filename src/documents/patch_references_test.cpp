// Reads the files of patches from the fields and children of geometry nodes.

#include "documents/testing.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::errorKindOf;
using testing::readBinaryGeometry;
using testing::shapeName;

TEST(PatchReferences, ReadsImagesFromImageTextures) {
  const SceneDocument document = readScene(R"(<html><body><x3d><scene><shape def="S"><appearance></appearance>
    <imagegeometry primType='TRIANGLESTRIP' vertexCount='9' implicitMeshSize='512 204'>
      <imagetexture containerField='index' url='i.png'></imagetexture>
      <imagetexture containerField='coord' url='"high.png"'><textureproperties></textureproperties></imagetexture>
      <imagetexture containerField='coord' url='low.png'></imagetexture>
      <imagetexture containerField='normal' url='n.png'></imagetexture>
    </imagegeometry></shape></scene></x3d></body></html>)",
                                           "x");
  ASSERT_EQ(document.geometries.size(), 1u);
  PatchDescription patch;
  patch.draws = {{Primitive::triangleStrip, 9}};
  patch.implicitMeshSize = {512, 204};
  patch.index = Reference{"i.png", {}};
  patch.coord = {{"high.png", {}}, {"low.png", {}}};
  patch.vertexAttributes[VertexRole::normal] = Reference{"n.png", {}};
  EXPECT_EQ(document.geometries[0].patches, std::vector<PatchDescription>{patch});
  EXPECT_EQ(document.geometries[0].lattice.bits, 16u);
  EXPECT_EQ(shapeName(document.graph, 0), "S");
}

TEST(PatchReferences, RefusesATextureWithoutAUrlHoweverDeeplyTexturesAreNested) {
  std::string begin = "<X3D><Scene><Shape><ImageGeometry>", end;
  for (int i = 0; i < 500000; ++i) {
    begin += "<Texture>";
    end += "</Texture>";
  }
  EXPECT_EQ(errorKindOf(begin + end + "</ImageGeometry></Shape></Scene></X3D>"), ErrorKind::malformed);
}

TEST(PatchReferences, ReadsTheStrideOfAUrlAsX3domDoes) {
  const auto referenceOf = [](const std::string& url) {
    return readBinaryGeometry("coordType='Int16' coord='" + url + "'").patches[0].coord[0];
  };
  EXPECT_EQ(referenceOf("a.bin"), (Reference{"a.bin", ByteLocation{}}));
  EXPECT_EQ(referenceOf("a.bin+8"), (Reference{"a.bin+8", ByteLocation{0, 8}}));
  EXPECT_EQ(referenceOf("a.bin?+8"), (Reference{"a.bin", ByteLocation{0, 8}}));
  EXPECT_EQ(referenceOf("a.bin#16+24"), (Reference{"a.bin", ByteLocation{16, 24}}));
  EXPECT_EQ(referenceOf("c++/a.bin"), (Reference{"c++/a.bin", ByteLocation{}}));
  EXPECT_EQ(referenceOf("+8"), (Reference{"+8", ByteLocation{0, 8}}));
}

TEST(PatchReferences, ReadsImagesGivenByUseTexturesAndImgElements) {
  const SceneDocument document = readScene("<X3D><Scene><Shape><ImageGeometry ccw='false' implicitMeshCount='64 32' "
                                           "primType='TRIANGLEFAN' vertexCount='3'>"
                                           "<ImageTexture DEF='A' containerField='coord' url='a.png'/>"
                                           "<Texture containerField='coord'><img src='b.png'/></Texture>"
                                           "<img containerField='normal' src='n.png'/>"
                                           "<ImageTexture USE='A' containerField='color'/>"
                                           "<Texture containerField='texCoord' url='t.png'/>"
                                           "<Texture containerField='texCoord' url='u.png'/>"
                                           "</ImageGeometry></Shape></Scene></X3D>",
                                           "s.x3d");
  const GeometryDescription& geometry = document.geometries.at(0);
  const PatchDescription& patch = geometry.patches.at(0);
  EXPECT_FALSE(geometry.ccw);
  EXPECT_EQ(patch.draws, (std::vector<Draw>{{Primitive::triangleFan, 3}}));
  EXPECT_EQ(patch.implicitMeshSize, (Vec2<std::uint32_t>{64, 32}));
  ASSERT_EQ(patch.coord.size(), 2u);
  EXPECT_EQ(patch.coord[1].url, "b.png");
  EXPECT_EQ(patch.vertexAttributes[VertexRole::normal]->url, "n.png");
  EXPECT_EQ(patch.vertexAttributes[VertexRole::color]->url, "a.png");
  EXPECT_EQ(patch.vertexAttributes[VertexRole::texCoord1]->url, "u.png");
}

TEST(PatchReferences, RefusesImagesThatItCannotRead) {
  const auto images = [](const std::string& children) {
    return "<X3D><Scene><Shape><ImageGeometry coord='a'>" + children + "</ImageGeometry></Shape></Scene></X3D>";
  };
  EXPECT_EQ(errorKindOf(images("<ImageTexture containerField='coord' USE='none'/>")), ErrorKind::malformed);
}

TEST(PatchReferences, LeavesOutImagesOfAttributesThatItCannotRead) {
  for (const char* image : {"<video containerField='normal'/>", "<Texture containerField='color'/>",
                            "<ImageTexture containerField='texcoords' url='a.png'/>"}) {
    const SceneDocument document = readScene("<X3D><Scene><Shape><ImageGeometry coord='a' vertexCount='3'>" +
                                                 std::string(image) + "</ImageGeometry></Shape></Scene></X3D>",
                                             "s.x3d");
    const PatchDescription& patch = document.geometries.at(0).patches.at(0);
    std::size_t files = 0;
    visitReferences(patch, [&](Role, const Reference&) { ++files; });
    EXPECT_EQ(files, 1u) << image;
    ASSERT_EQ(document.warnings.size(), 1u) << image;
    EXPECT_NE(document.warnings[0].find("left out"), std::string::npos) << document.warnings[0];
  }
}

TEST(PatchReferences, HasTheImagesOfChildrenInsteadOfThoseOfTheFields) {
  const SceneDocument document =
      readScene("<X3D><Scene><Shape><ImageGeometry coord='a' vertexCount='3' normal='\"n\" \"o\"' color='c'>"
                "<ImageTexture containerField='coord' url='b'/><ImageTexture containerField='normal' url='p'/>"
                "</ImageGeometry></Shape></Scene></X3D>",
                "s.x3d");
  const PatchDescription& patch = document.geometries.at(0).patches.at(0);
  ASSERT_EQ(patch.coord.size(), 1u);
  EXPECT_EQ(patch.coord[0].url, "b");
  EXPECT_EQ(patch.vertexAttributes[VertexRole::normal]->url, "p");
  EXPECT_TRUE(patch.lowBytes[VertexRole::normal].empty());
  EXPECT_EQ(patch.vertexAttributes[VertexRole::color]->url, "c");
}

TEST(PatchReferences, KeepsTheFurtherUrlsOfAFile) {
  const SceneDocument images = readScene(R"(<X3D><Scene><Shape><ImageGeometry vertexCount='3' index='"i.png" "j.png"'>
      <ImageTexture containerField='coord' url='"a.png#3" "b.png#3" "c.png"'/></ImageGeometry></Shape></Scene></X3D>)",
                                         "s.x3d");
  const PatchDescription& patch = images.geometries.at(0).patches.at(0);
  EXPECT_EQ(patch.coord.at(0), (Reference{"a.png", TexelLocation{3}, {"b.png"}}));
  EXPECT_EQ(patch.index, (Reference{"i.png", TexelLocation{}, {"j.png"}}));
  ASSERT_EQ(images.warnings.size(), 1u);
  EXPECT_NE(images.warnings[0].find("different fragments"), std::string::npos);

  const SceneDocument arrays = readScene(R"(<X3D><Scene><Shape><BinaryGeometry coordType='Uint16'
      normalAsSphericalCoordinates='true' coord='"a.bin" "b.bin"'/></Shape></Scene></X3D>)",
                                         "s.x3d");
  const PatchDescription& binary = arrays.geometries.at(0).patches.at(0);
  EXPECT_EQ(binary.coord.at(0), (Reference{"a.bin", ByteLocation{}, {"b.bin"}}));
  EXPECT_EQ(binary.vertexAttributes[VertexRole::normal]->furtherUrls, std::vector<std::string>{"b.bin"});
}

TEST(PatchReferences, WarnsOfImagesBeyondThoseThatAnAttributeHas) {
  std::string text = "<X3D><Scene><Shape><ImageGeometry vertexCount='3'>";
  for (const char* role : {"coord", "index", "normal", "color", "texCoord"})
    for (int i = 0; i < 5; ++i)
      text += std::string("<ImageTexture containerField='") + role + "' url='" + role + std::to_string(i) + ".png'/>";
  const SceneDocument document = readScene(text + "</ImageGeometry></Shape></Scene></X3D>", "s.x3d");
  const PatchDescription& patch = document.geometries.at(0).patches.at(0);
  EXPECT_EQ(patch.coord.size(), 4u);
  EXPECT_EQ(patch.index->url, "index0.png");
  EXPECT_EQ(patch.lowBytes[VertexRole::normal].size(), 1u);
  EXPECT_EQ(patch.lowBytes[VertexRole::color].size(), 2u);
  EXPECT_EQ(patch.vertexAttributes[VertexRole::texCoord3]->url, "texCoord3.png");
  ASSERT_EQ(document.warnings.size(), 5u);
  for (const char* expected :
       {"only the first 4 of 5 coord", "only the first 1 of 5 index", "only the first 2 of 5 normal",
        "only the first 3 of 5 color", "only the first 4 of 5 texCoord"})
    EXPECT_TRUE(std::ranges::any_of(document.warnings, [&](const std::string& warning) {
      return warning.find(std::string("ImageGeometry: ") + expected + " images are used; the others are left out.") !=
             warning.npos;
    })) << expected;
}

} // namespace
} // namespace imgeo
