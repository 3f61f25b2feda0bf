// Reads texts of documents: those of other programs, with defaults, and damaged ones.

#include "base/error.h"
#include "documents/documents.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::shapeName;

ErrorKind errorKindOf(const std::string& text, const std::string& location = "") {
  try {
    readScene(text, "s.x3d");
  } catch (const Error& error) {
    EXPECT_TRUE(location.empty() || location == error.location()) << error.what();
    return error.kind();
  }
  ADD_FAILURE() << "was read: " << text;
  return ErrorKind::usage;
}

TEST(ReadScene, ReadsImagesFromImageTextures) {
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

TEST(ReadScene, RefusesATextureWithoutAUrlHoweverDeeplyTexturesAreNested) {
  std::string begin = "<X3D><Scene><Shape><ImageGeometry>", end;
  for (int i = 0; i < 500000; ++i) {
    begin += "<Texture>";
    end += "</Texture>";
  }
  EXPECT_EQ(errorKindOf(begin + end + "</ImageGeometry></Shape></Scene></X3D>"), ErrorKind::malformed);
}

TEST(ReadScene, IgnoresTextThatResemblesTheX3dElement) {
  const SceneDocument document = readScene("<!DOCTYPE html><!-- <X3D> --><script>'<X3D>'</script><title><x3d></title>"
                                           "<p title='<X3D>'></p><X3D><Scene><WorldInfo title='here'/></Scene></X3D>",
                                           "x");
  EXPECT_EQ(document.graph.title, "here");
}

TEST(ReadScene, RefusesDocumentTypesAndEntities) {
  EXPECT_EQ(errorKindOf("<!DOCTYPE X3D [<!ENTITY a 'aaaaaaaa'>]><X3D><Scene/></X3D>", "s.x3d:1"),
            ErrorKind::unsupported);
  EXPECT_EQ(errorKindOf("<!DOCTYPE X3D SYSTEM 'file:///etc/passwd'><X3D><Scene/></X3D>"), ErrorKind::unsupported);
  EXPECT_EQ(errorKindOf("<X3D>\n<Scene><WorldInfo title='&a;'/></Scene></X3D>", "s.x3d:2"), ErrorKind::malformed);
  EXPECT_EQ(errorKindOf("<X3D><!ENTITY a 'b'><Scene/></X3D>"), ErrorKind::malformed);
}

TEST(ReadScene, ReportsTheLineOfAFieldThatCannotBeReadAndOfOneThatCountsAsAbsent) {
  const std::string before = "<X3D><Scene>\n<Shape>\n";
  const auto shape = [&](const std::string& fields) {
    const std::string count = fields.starts_with("vertexCount") ? "" : " vertexCount='3'";
    return before + "<ImageGeometry><GeometryPatch coord='a' " + fields + count +
           "></GeometryPatch></ImageGeometry></Shape></Scene></X3D>";
  };
  for (const std::string fields : {"vertexCount='-1'", "recordCount='-1'", "index='a#b'", "index='#5'", "index='a#1+4'",
                                   "index='a#1#4'", "implicitMeshSize='0 1'", "implicitMeshSize='1e9 1'"})
    EXPECT_EQ(errorKindOf(shape(fields), "s.x3d:3"), ErrorKind::malformed) << fields;
  for (const auto& [fields, sentence] : std::initializer_list<std::pair<std::string, std::string>>{
           {"recordCount='1 2'", "recordCount=\"1 2\" is no SFInt32"},
           {"bboxSize='1 nan 1'", "bboxSize=\"1 nan 1\" is no SFVec3f"},
           {"bboxSize='1 1e39 1'", "bboxSize=\"1 1e39 1\" is no SFVec3f"},
           {"bboxSize='1 1'", "bboxSize=\"1 1\" is no SFVec3f"}})
    EXPECT_EQ(readScene(shape(fields), "s.x3d").warnings,
              std::vector{"s.x3d:3: GeometryPatch: " + sentence + "; it counts as absent."});
}

GeometryDescription readBinaryGeometry(const std::string& fields) {
  const SceneDocument document =
      readScene("<X3D><Scene><Shape><BinaryGeometry " + fields + "/></Shape></Scene></X3D>", "x");
  return document.geometries.at(0);
}

TEST(ReadScene, RefusesImagesOfWhichNothingIsDrawn) {
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

TEST(ReadScene, ReadsTheStrideOfAUrlAsX3domDoes) {
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

TEST(ReadScene, CentresSignedCoordinatesInABoxOfAnyShape) {
  const Lattice lattice = readBinaryGeometry("coordType='Int16' position='1 2 3' size='4 2 0' coord='a'").lattice;
  EXPECT_EQ(lattice.bits, 16u);
  const Vec3d middle = lattice.point({32768, 32768, 32768}), corner = lattice.point({32768 + 32767, 32768 - 32767, 0});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(middle[axis], (Vec3d{1, 2, 3}[axis]), 1e-12);
    EXPECT_NEAR(corner[axis], (Vec3d{5, 0, 3}[axis]), 1e-12);
  }
}

TEST(ReadScene, RefusesAttributesThatPatchesLack) {
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

TEST(ReadScene, UsesX3domsDefaultsForABinaryGeometry) {
  const GeometryDescription geometry = readBinaryGeometry("coord='a' index='i'");
  EXPECT_EQ(geometry.coordType, ElementType::float32);
  EXPECT_EQ(geometry.indexType, ElementType::uint16);
  EXPECT_EQ(geometry.normalEncoding, NormalEncoding::rgb);
  EXPECT_EQ(geometry.patches[0].draws, (std::vector<Draw>{{Primitive::triangles, 0}}));
}

TEST(ReadScene, ReadsX3domsSphericalNormalsFromTheFourthElementOfCoordinates) {
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

TEST(ReadScene, ReadsIndicesOf16And32BitsFromImages) {
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

TEST(ReadScene, JoinsAGroupOfShapesThatShareTheirAppearance) {
  const auto shape = [](const std::string& appearance, const std::string& coord) {
    return "<Shape bboxSize='1 1 1'><Appearance " + appearance +
           "><Material diffuseColor='1 0 0'/></Appearance>"
           "<BinaryGeometry size='2 2 2' coordType='Uint16' coord='" +
           coord + "'/></Shape>";
  };
  const auto scene = [](const std::string& shapes) {
    return readScene("<X3D><Scene><Group DEF='statue' bboxSize='3 3 3'>" + shapes + "</Group></Scene></X3D>", "x");
  };
  const SceneDocument joined = scene(shape("DEF='A'", "a") + shape("USE='A'", "b"));
  ASSERT_EQ(shapeNodes(joined.graph).size(), 1u);
  EXPECT_EQ(shapeName(joined.graph, 0), "statue");
  EXPECT_EQ(testing::appearanceOf(joined.graph, 0).material, AnyMaterial(Material{.diffuseColor{1, 0, 0}}));
  ASSERT_EQ(joined.geometries.at(0).patches.size(), 2u);
  EXPECT_EQ(joined.geometries[0].patches[1].coord[0].url, "b");
  EXPECT_EQ(joined.geometries[0].patches[1].box.size(), (Vec3d{1, 1, 1}));
  EXPECT_EQ(joined.geometries[0].box.size(), (Vec3d{3, 3, 3}));

  EXPECT_EQ(shapeNodes(scene(shape("DEF='A'", "a") + shape("DEF='B'", "b")).graph).size(), 2u);
  EXPECT_EQ(shapeNodes(scene(shape("", "a") + shape("", "b")).graph).size(), 2u);
  const std::string otherBox =
      "<Shape><Appearance USE='A'/><BinaryGeometry size='3 3 3' coordType='Uint16' coord='b'/></Shape>";
  EXPECT_EQ(shapeNodes(scene(shape("DEF='A'", "a") + otherBox).graph).size(), 2u);
}

TEST(ReadScene, RefusesGeometryWithoutALattice) {
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

TEST(ReadScene, ReadsImagesGivenByUseTexturesAndImgElements) {
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

TEST(ReadScene, TakesThePrecisionOfAttributesFromTheirImagesUnlessTheNodeStatesIt) {
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

TEST(ReadScene, RefusesImagesThatItCannotRead) {
  const auto images = [](const std::string& children) {
    return "<X3D><Scene><Shape><ImageGeometry coord='a'>" + children + "</ImageGeometry></Shape></Scene></X3D>";
  };
  EXPECT_EQ(errorKindOf(images("<ImageTexture containerField='coord' USE='none'/>")), ErrorKind::malformed);
}

TEST(ReadScene, DrawsTrianglesWhereNoKnownPrimTypeIsStated) {
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

TEST(ReadScene, LeavesOutGeometryThatIsInNoFile) {
  const std::string movie = "a movie with coordinates names a lossless video and the index of its frames",
                    videos = "movies are not drawn; images and live streams are",
                    stream = "a live stream is in no file";
  const std::pair<std::string, std::string> cases[] = {
      {"><MovieTexture containerField='coord' url='a.mp4'/>", movie},
      {"><Texture containerField='coord'><video src='a.mp4'/></Texture>", videos},
      {"><GeometryPatch><video containerField='coord' src='a.mp4'/></GeometryPatch>", videos},
      {"><Texture containerField='coord'><canvas/></Texture>", "a canvas has pixels only in a page"},
      {"><PixelTexture containerField='coord'/>", "the pixels of a PixelTexture are not read as geometry; images are"},
      {" coord='live/cloth'>", stream},
      {" coord='https://a.example/live/cloth-1?token=a/b'>", stream},
      {"><MovieTexture containerField='coord' url='live/cloth'/>", stream},
      {"><ImageTexture containerField='coord' url='live/cloth'/>", stream},
  };
  for (const auto& [geometry, reason] : cases) {
    SCOPED_TRACE(geometry);
    const SceneDocument document =
        readScene("<X3D><Scene>\n<Shape><ImageGeometry DEF='g'" + geometry +
                      "</ImageGeometry></Shape><Shape><ImageGeometry USE='g'/></Shape>"
                      "<Shape><ImageGeometry coord='alive/c' vertexCount='3'/></Shape></Scene></X3D>",
                  "folder/s.x3d");
    EXPECT_EQ(document.geometries.size(), 1u);
    EXPECT_EQ(document.warnings,
              std::vector<std::string>{"s.x3d:2: ImageGeometry: " + reason + "; its Shape is left out."});
  }
}

TEST(ReadScene, ReadsTheMovieOfAGeometry) {
  const SceneDocument document = readScene(
      "<X3D><Scene><Shape><ImageGeometry coord='a' vertexCount='3'><MovieTexture DEF='m' containerField='coord' "
      R"(url='"g/v.webm" "g/i.json?v=2"' loop='true'/></ImageGeometry></Shape></Scene></X3D>)",
      "s.x3d");
  EXPECT_EQ(document.warnings, std::vector<std::string>{});
  ASSERT_EQ(document.graph.nodes.size(), 2u);
  const auto& frames = std::get<Interpolator>(document.graph.nodes[0].content);
  EXPECT_EQ(frames.video, "g/v.webm");
  EXPECT_EQ(frames.url, "g/i.json?v=2");
  EXPECT_EQ(document.geometries.at(0).patches.at(0).coord.size(), 1u);
}

TEST(ReadScene, LeavesOutImagesOfAttributesThatItCannotRead) {
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

TEST(ReadScene, HasTheImagesOfChildrenInsteadOfThoseOfTheFields) {
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

TEST(ReadScene, KeepsTheFurtherUrlsOfAFile) {
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

TEST(ReadScene, WarnsOfImagesBeyondThoseThatAnAttributeHas) {
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

TEST(ReadScene, WarnsOfMalformedFieldsAndReadsTheRest) {
  const SceneDocument document =
      readScene("<X3D><Scene>\n<Shape/><Viewpoint position='1 2' fieldOfView='1'/>\n"
                "<Shape><Appearance USE='a'/><ImageGeometry coord='c' vertexCount='3'/></Shape>"
                "</Scene></X3D>",
                "folder/s.x3d");
  EXPECT_EQ(document.warnings,
            (std::vector<std::string>{
                "s.x3d:2: Viewpoint: position=\"1 2\" is no SFVec3f; it counts as absent.",
                "s.x3d:3: Appearance: USE names no Appearance that stands before; it has its defaults."}));
  const Viewpoint& viewpoint = std::get<Viewpoint>(document.graph.nodes.at(0).content);
  EXPECT_EQ(viewpoint.position, Viewpoint{}.position);
  EXPECT_EQ(viewpoint.fieldOfView, 1);
  EXPECT_EQ(shapeNodes(document.graph).size(), 1u);
}

TEST(ReadScene, RefusesExcessiveDepth) {
  std::string text = "<X3D><Scene>";
  for (int i = 0; i < 100000; ++i)
    text += "<Group>";
  for (int i = 0; i < 100000; ++i)
    text += "</Group>";
  EXPECT_EQ(errorKindOf(text + "</Scene></X3D>"), ErrorKind::limit);

  std::string chain = "<X3D><Scene><Group DEF='g0'></Group>";
  for (int i = 1; i < 100000; ++i)
    chain += "<Group DEF='g" + std::to_string(i) + "'><Group USE='g" + std::to_string(i - 1) + "'/></Group>";
  EXPECT_EQ(errorKindOf(chain + "</Scene></X3D>"), ErrorKind::limit);
}

TEST(ReadScene, RefusesAUseWithoutADefBefore) {
  for (const std::string use : {"<Shape USE='a'/>", "<Group DEF='a'><Group USE='a'/></Group>",
                                "<Transform USE='a'/><Transform DEF='a'/>", "<Shape><ImageGeometry USE='a'/></Shape>"})
    EXPECT_EQ(errorKindOf("<X3D><Scene>" + use + "</Scene></X3D>"), ErrorKind::malformed) << use;
}

} // namespace
} // namespace imgeo
