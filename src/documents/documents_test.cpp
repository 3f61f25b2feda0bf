#include "documents/documents.h"

#include "base/error.h"
#include "containers/named_attributes.h"
#include "containers/stored_coords.h"
#include "containers/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::Random;

/// Text with everything in it that markup could stumble over.
std::string randomText(Random& random) {
  static const char* pieces[] = {"a",       "\"",  "'",  "<",    ">",    "&",     "&amp;",  "</script>",
                                 "-->",     "]]>", "\n", "\t",   "\r\n", "<X3D>", "</X3D>", "é",
                                 "像",      "𝄞",   " ",  "  ",   "\\",   "\\\"",  "#",      "\xc2\x85",
                                 "&#60;x&", "=",   "/>", "<!--", "%",    "0"};
  std::string text = "t"; // leading white space is kept too, but nobody needs it
  for (std::uint32_t count = random.below(8); count > 0; --count)
    text += pieces[random.below(std::size(pieces))];
  return text;
}

Vec3d randomVector(Random& random) {
  return Vec3d(random.point()) * std::exp2(static_cast<double>(random.below(60)) - 30);
}
Vec3f randomColor(Random& random) {
  return random.point() * 0.5f + Vec3f{0.5f, 0.5f, 0.5f};
}
Box3d randomBox(Random& random) {
  Box3d box;
  if (random.once(5))
    return box;
  box.add(randomVector(random));
  box.add(randomVector(random));
  return box;
}

Reference randomReference(Random& random, Container container) {
  Reference reference{"f" + std::to_string(random.below(1000)) + (random.once(3) ? "\" &'<x>.png" : ".bin"),
                      0, 0};
  if (random.once(2))
    reference.first = random.bits();
  if (container == Container::bg && random.once(2))
    reference.stride = 1 + random.below(64);
  return reference;
}

PatchDescription randomPatch(Random& random, Container container, std::size_t planes) {
  PatchDescription patch;
  patch.box = randomBox(random);
  patch.vertexCount = random.bits();
  for (std::uint32_t draws = 1 + random.below(3); draws > 0; --draws)
    patch.draws.push_back({static_cast<Primitive>(random.below(4)), random.bits()});
  if (container == Container::sig)
    patch.implicitMeshSize = {1 + random.below(4096), 1 + random.below(4096)};
  if (random.once(2))
    patch.index = randomReference(random, container);
  for (std::size_t plane = 0; plane < planes; ++plane)
    patch.coord.push_back(randomReference(random, container));
  if (random.once(2))
    patch.normal = randomReference(random, container);
  if (random.once(2))
    patch.texCoord = randomReference(random, container);
  if (random.once(2))
    patch.color = randomReference(random, container);
  return patch;
}

GeometryDescription randomGeometry(Random& random) {
  GeometryDescription geometry;
  geometry.container = random.once(2) ? Container::sig : Container::bg;
  geometry.lattice = {randomVector(random), length(randomVector(random)) + 1e-6, 8 + random.below(25)};
  geometry.box = randomBox(random);
  if (random.once(2))
    geometry.texCoordMin = {random.between(-5, 5), random.between(-5, 5)};
  if (random.once(2))
    geometry.texCoordSize = {random.between(0, 5), 0};
  geometry.colorComponents = 3 + random.below(2);
  if (geometry.container == Container::bg) {
    do
      geometry.coordType = static_cast<ElementType>(random.below(7));
    while (!holdsLattice(geometry.coordType, geometry.lattice.bits));
    geometry.normalType = static_cast<ElementType>(random.below(7));
    geometry.indexType = static_cast<ElementType>(random.below(7));
  }
  geometry.normalEncoding = static_cast<NormalEncoding>(random.below(4));
  for (std::uint32_t count = random.once(2) ? random.below(3) : 0; count > 0; --count) {
    AttributeDescription attribute{"a" + std::to_string(count) + "<&\"", 1 + random.below(4), 2, {}, {}};
    if (geometry.container == Container::sig)
      attribute.bytes = 1 + random.below(3);
    for (std::uint32_t c = 0; c < attribute.components; ++c) {
      attribute.min.push_back(random.between(-5, 5));
      attribute.size.push_back(random.between(0, 5));
    }
    geometry.attributes.push_back(attribute);
  }
  if (geometry.container == Container::sig && random.once(2))
    geometry.indexType = ElementType::uint32;
  for (std::uint32_t patches = 1 + random.below(4); patches > 0; --patches)
    geometry.patches.push_back(randomPatch(
        random, geometry.container,
        geometry.container == Container::sig ? coordBytes(Container::sig, geometry.lattice.bits) : 1));
  for (PatchDescription& patch : geometry.patches)
    for (const AttributeDescription& attribute : geometry.attributes) {
      patch.attributes.emplace_back();
      for (std::size_t file = filesOf(geometry.container, attribute); file > 0; --file)
        patch.attributes.back().push_back(randomReference(random, geometry.container));
    }
  if (geometry.container == Container::bg && byteSizeOf(geometry.coordType) == 2 && random.once(3)) {
    geometry.normalEncoding = NormalEncoding::spherical;
    geometry.normalType = ElementType::uint8;
    for (PatchDescription& patch : geometry.patches)
      patch.normal = normalInCoords(patch.coord[0]);
  }
  return geometry;
}

SceneDocument randomDocument(std::uint32_t seed) {
  Random random(seed);
  SceneDocument document;
  if (!random.once(4))
    document.title = randomText(random);
  for (std::uint32_t shapes = random.below(4); shapes > 0; --shapes) {
    Shape shape;
    if (!random.once(3))
      shape.name = "Größe_" + std::to_string(shapes) + ".a-b";
    shape.mesh = document.geometries.size();
    if (random.once(2))
      shape.material.diffuseColor = randomColor(random);
    if (random.once(2))
      shape.material.specularColor = randomColor(random);
    if (random.once(2))
      shape.material.shininess = random.between(0, 1);
    if (random.once(2))
      shape.material.transparency = random.between(0, 1);
    document.shapes.push_back(shape);
    document.geometries.push_back(randomGeometry(random));
  }
  for (std::uint32_t views = random.below(3); views > 0; --views)
    document.viewpoints.push_back({random.once(2) ? "" : randomText(random), randomVector(random),
                                   randomVector(random), random.between(-3, 3), random.between(0.1f, 3),
                                   randomVector(random)});
  for (std::uint32_t lights = random.below(3); lights > 0; --lights)
    document.lights.push_back({randomVector(random), randomColor(random), random.between(0, 1)});
  document.headlight = random.once(2);
  return document;
}

/// Boxes are written as centre and size, which costs a rounding or two.
void expectNear(const Box3d& a, const Box3d& b) {
  EXPECT_EQ(a.empty(), b.empty());
  if (a.empty() || b.empty())
    return;
  for (int axis = 0; axis < 3; ++axis) {
    const double ulps = 8e-16 * std::max(std::abs(b.min[axis]), std::abs(b.max[axis]));
    EXPECT_NEAR(a.min[axis], b.min[axis], ulps);
    EXPECT_NEAR(a.max[axis], b.max[axis], ulps);
  }
}

void expectEqual(const GeometryDescription& read, GeometryDescription written) {
  expectNear(read.box, written.box);
  EXPECT_EQ(read.lattice.bits, written.lattice.bits);
  const double reach = length(written.lattice.origin) + written.lattice.step * written.lattice.maximum();
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(read.lattice.origin[axis], written.lattice.origin[axis], 1e-15 * reach);
  EXPECT_NEAR(read.lattice.step * read.lattice.maximum(), written.lattice.step * written.lattice.maximum(),
              1e-15 * reach);
  ASSERT_EQ(read.patches.size(), written.patches.size());
  for (std::size_t i = 0; i < read.patches.size(); ++i) {
    expectNear(read.patches[i].box, written.patches[i].box);
    written.patches[i].box = read.patches[i].box;
  }
  written.box = read.box;
  written.lattice = read.lattice;
  EXPECT_EQ(read, written);
}

void expectEqual(const SceneDocument& read, const SceneDocument& written) {
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.headlight, written.headlight);
  ASSERT_EQ(read.shapes.size(), written.shapes.size());
  for (std::size_t i = 0; i < read.shapes.size(); ++i) {
    EXPECT_EQ(read.shapes[i].name, written.shapes[i].name);
    EXPECT_EQ(read.shapes[i].material, written.shapes[i].material);
    expectEqual(read.geometries.at(read.shapes[i].mesh), written.geometries.at(written.shapes[i].mesh));
  }
  ASSERT_EQ(read.viewpoints.size(), written.viewpoints.size());
  for (std::size_t i = 0; i < read.viewpoints.size(); ++i) {
    const Viewpoint &a = read.viewpoints[i], &b = written.viewpoints[i];
    EXPECT_EQ(a.description, b.description);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.orientationAxis, b.orientationAxis);
    EXPECT_EQ(a.orientationAngle, b.orientationAngle);
    EXPECT_EQ(a.fieldOfView, b.fieldOfView);
    EXPECT_EQ(a.centerOfRotation, b.centerOfRotation);
  }
  ASSERT_EQ(read.lights.size(), written.lights.size());
  for (std::size_t i = 0; i < read.lights.size(); ++i) {
    EXPECT_EQ(read.lights[i].direction, written.lights[i].direction);
    EXPECT_EQ(read.lights[i].color, written.lights[i].color);
    EXPECT_EQ(read.lights[i].intensity, written.lights[i].intensity);
  }
}

const PageOptions page{"imgeo-viewer.js", "imgeo.css"};

TEST(Documents, ComeBackFromX3dAndFromHtml) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const SceneDocument document = randomDocument(seed);
    expectEqual(readScene(writeX3d(document), "scene.x3d"), document);
    expectEqual(readScene(writeHtml(document, page), "index.html"), document);
  }
}

TEST(Documents, AreReadWithoutRegardToCase) {
  const SceneDocument document = randomDocument(3);
  std::string text = writeX3d(document);
  const auto lowerNames = [](std::string& x3d) {
    bool inTag = false;
    char quote = 0;
    for (char& c : x3d) {
      if (quote != 0)
        quote = c == quote ? char{0} : quote;
      else if (inTag && (c == '"' || c == '\''))
        quote = c;
      else if (c == '<')
        inTag = true;
      else if (c == '>')
        inTag = false;
      else if (inTag && c >= 'A' && c <= 'Z')
        c = static_cast<char>(c + 32);
    }
  };
  lowerNames(text);
  EXPECT_NE(text.find("<x3d"), std::string::npos);
  expectEqual(readScene(text, "x"), document);
}

TEST(Documents, HoldTheSameElementInBothForms) {
  const SceneDocument document = randomDocument(5);
  const auto withoutIndents = [](std::string_view text) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i)
      if (text[i] != ' ' || (i > 0 && text[i - 1] != '\n' && text[i - 1] != ' '))
        out += text[i];
    return out.substr(out.find("<X3D"), out.rfind("</X3D>") - out.find("<X3D"));
  };
  EXPECT_EQ(withoutIndents(writeX3d(document)), withoutIndents(writeHtml(document, page)));
}

SceneDocument documentNamed(const std::string& name) {
  SceneDocument document;
  document.title = name;
  GeometryDescription geometry;
  geometry.patches = {
      {{}, 3, {{Primitive::triangles, 3}}, {256, 1}, {}, {{"a.png", 0, 0}, {"b.png", 0, 0}}, {}, {}, {}, {}, {}}};
  document.geometries = {geometry, geometry};
  document.shapes = {{name, 0, {}}, {name, 1, {}}};
  document.viewpoints = {{name, {}, {0, 0, 1}, 0, 0.8, {}}};
  return document;
}

TEST(Documents, DoNotRunWhatANameSays) {
  for (const std::string name : {"\"><script>alert(1)</script>", "' onload='alert(1)", "</title><script>",
                                 "--><script>", "</noscript><script>", "a\0b<script>"}) {
    const std::string html = writeHtml(documentNamed(name), page);
    EXPECT_EQ(html.find("<script"), html.rfind("<script")) << html;
    EXPECT_EQ(readScene(html, "x").title, name);
    EXPECT_EQ(readScene(html, "x").viewpoints.at(0).description, name);
  }
}

TEST(Documents, GiveShapesValidUniqueNames) {
  EXPECT_EQ(readScene(writeX3d(documentNamed("\"><script>")), "x").shapes[0].name, "___script_");
  EXPECT_EQ(readScene(writeX3d(documentNamed("2 hares")), "x").shapes[0].name, "_2_hares");
  EXPECT_EQ(readScene(writeX3d(documentNamed("2 hares")), "x").shapes[1].name, "_2_hares_2");
  EXPECT_EQ(readScene(writeX3d(documentNamed("\xff\xfe")), "x").shapes[0].name, "__");
  EXPECT_EQ(readScene(writeX3d(documentNamed("")), "x").shapes[1].name, "");
}

TEST(Documents, AreValidUtf8WhateverTheirNamesAre) {
  const SceneDocument read =
      readScene(writeHtml(documentNamed("a\xc3(\xed\xa0\x80\x01z\xf0\x9f"), page), "x");
  const std::string r = "\xef\xbf\xbd";
  EXPECT_EQ(read.title, "a" + r + "(" + r + r + r + r + "z" + r + r);
}

TEST(Html, HintsAtTheFirstPlanesThenAtTheIndices) {
  SceneDocument document = documentNamed("a");
  document.geometries[0].patches[0].index = {"i.png", 0, 0};
  document.geometries[1].patches[0].coord[0].url = "c.png";
  const std::string html = writeHtml(document, page);
  std::string hints;
  const std::string hint =
      "<link rel=\"preload\" as=\"fetch\" crossorigin=\"anonymous\" fetchpriority=\"high\" href=\"";
  for (std::size_t at = html.find(hint); at != std::string::npos; at = html.find(hint, at + 1))
    hints += html.substr(at + hint.size(), 5) + " ";
  EXPECT_EQ(hints, "a.png c.png i.png ");
}

TEST(Html, HintsAtNoMoreThanSixteenFiles) {
  SceneDocument document = documentNamed("a");
  for (int i = 0; i < 100; ++i) {
    document.geometries[0].patches.push_back(document.geometries[0].patches[0]);
    document.geometries[0].patches.back().coord[0].url = std::to_string(i);
  }
  const std::string html = writeHtml(document, page);
  std::size_t hints = 0;
  for (std::size_t at = html.find("as=\"fetch\""); at != std::string::npos;
       at = html.find("as=\"fetch\"", at + 1))
    ++hints;
  EXPECT_EQ(hints, 16u);
}

TEST(Html, NeedsNothingInline) {
  const std::string html = writeHtml(randomDocument(8), page);
  EXPECT_EQ(html.find("<style"), std::string::npos);
  EXPECT_EQ(html.find("style="), std::string::npos);
  EXPECT_NE(html.find("<script type=\"module\" src=\"imgeo-viewer.js\"></script>"), std::string::npos);
  EXPECT_NE(html.find("<link rel=\"stylesheet\" href=\"imgeo.css\">"), std::string::npos);
  EXPECT_NE(pageStylesheet().find("x3d {"), std::string::npos);
}

ErrorKind kindOfReading(const std::string& text, const std::string& place = "") {
  try {
    readScene(text, "s.x3d");
  } catch (const Error& error) {
    EXPECT_TRUE(place.empty() || place == error.place()) << error.what();
    return error.kind();
  }
  ADD_FAILURE() << "was read: " << text;
  return ErrorKind::usage;
}

TEST(ReadScene, TakesImageTexturesForImages) {
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
  patch.index = Reference{"i.png", 0, 0};
  patch.coord = {{"high.png", 0, 0}, {"low.png", 0, 0}};
  patch.normal = Reference{"n.png", 0, 0};
  EXPECT_EQ(document.geometries[0].patches, std::vector<PatchDescription>{patch});
  EXPECT_EQ(document.geometries[0].lattice.bits, 16u);
  EXPECT_EQ(document.shapes[0].name, "S");
}

TEST(ReadScene, FindsTheElementPastWhatOnlyLooksLikeIt) {
  const SceneDocument document =
      readScene("<!DOCTYPE html><!-- <X3D> --><script>'<X3D>'</script><title><x3d></title>"
                "<p title='<X3D>'></p><X3D><Scene><WorldInfo title='here'/></Scene></X3D>",
                "x");
  EXPECT_EQ(document.title, "here");
}

TEST(ReadScene, RefusesDocumentTypesAndEntities) {
  EXPECT_EQ(kindOfReading("<!DOCTYPE X3D [<!ENTITY a 'aaaaaaaa'>]><X3D><Scene/></X3D>", "s.x3d:1"),
            ErrorKind::unsupported);
  EXPECT_EQ(kindOfReading("<!DOCTYPE X3D SYSTEM 'file:///etc/passwd'><X3D><Scene/></X3D>"),
            ErrorKind::unsupported);
  EXPECT_EQ(kindOfReading("<X3D>\n<Scene><WorldInfo title='&a;'/></Scene></X3D>", "s.x3d:2"),
            ErrorKind::malformed);
  EXPECT_EQ(kindOfReading("<X3D><!ENTITY a 'b'><Scene/></X3D>"), ErrorKind::malformed);
}

TEST(ReadScene, SaysOnWhichLineAFieldIsWrong) {
  const std::string before = "<X3D><Scene>\n<Shape>\n";
  const auto shape = [&](const std::string& fields) {
    return before + "<ImageGeometry><GeometryPatch coord='a' " + fields +
           "></GeometryPatch></ImageGeometry></Shape></Scene></X3D>";
  };
  for (const std::string fields :
       {"vertexCount='-1'", "vertexCount='4294967296'", "vertexCount='3 3' primType='POINTS'", "index='a#b'",
        "index='#5'", "index='a#1+4'", "recordCount='1 2'", "bboxSize='1 nan 1'", "bboxSize='1 1e39 1'",
        "bboxSize='1 1'", "implicitMeshSize='0 1'", "implicitMeshSize='1e9 1'"})
    EXPECT_EQ(kindOfReading(shape(fields), "s.x3d:3"), ErrorKind::malformed) << fields;
}

GeometryDescription readBinaryGeometry(const std::string& fields) {
  const SceneDocument document =
      readScene("<X3D><Scene><Shape><BinaryGeometry " + fields + "/></Shape></Scene></X3D>", "x");
  return document.geometries.at(0);
}

TEST(ReadScene, FindsTheStrideOfAUrlAsX3domDoes) {
  const auto referenceOf = [](const std::string& url) {
    return readBinaryGeometry("coordType='Int16' coord='" + url + "'").patches[0].coord[0];
  };
  EXPECT_EQ(referenceOf("a.bin"), (Reference{"a.bin", 0, 0}));
  EXPECT_EQ(referenceOf("a.bin+8"), (Reference{"a.bin+8", 0, 8}));
  EXPECT_EQ(referenceOf("a.bin?+8"), (Reference{"a.bin", 0, 8}));
  EXPECT_EQ(referenceOf("a.bin#16+24"), (Reference{"a.bin", 16, 24}));
  EXPECT_EQ(referenceOf("c++/a.bin"), (Reference{"c++/a.bin", 0, 0}));
  EXPECT_EQ(referenceOf("+8"), (Reference{"+8", 0, 8}));
}

TEST(ReadScene, PutsSignedCoordinatesAroundTheCentreOfABoxOfAnyShape) {
  const Lattice lattice =
      readBinaryGeometry("coordType='Int16' position='1 2 3' size='4 2 0' coord='a'").lattice;
  EXPECT_EQ(lattice.bits, 16u);
  const Vec3d middle = lattice.point({32768, 32768, 32768}),
              corner = lattice.point({32768 + 32767, 32768 - 32767, 0});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(middle[axis], (Vec3d{1, 2, 3}[axis]), 1e-12);
    EXPECT_NEAR(corner[axis], (Vec3d{5, 0, 3}[axis]), 1e-12);
  }
}

TEST(Documents, KeepTheLatticeOfForeignGeometry) {
  for (const std::string type : {"Int8", "Int16", "Uint8", "Uint16", "Uint32", "Float32"})
    for (const std::string size : {"4 2 0", "1 1 1", "1e-3 5 100"}) {
      const SceneDocument document =
          readScene("<X3D><Scene><Shape><BinaryGeometry coordType='" + type + "' position='1 2 3' size='" +
                        size + "' coord='a'/></Shape></Scene></X3D>",
                    "x");
      const Lattice before = document.geometries.at(0).lattice;
      const Lattice after = readScene(writeX3d(document), "x").geometries.at(0).lattice;
      const std::uint32_t most = before.maximum();
      const Vec3u corners[] = {{0, 0, 0}, {most, most, most}, {most / 2, most / 3, 1}};
      for (const Vec3u& q : corners)
        EXPECT_LE(length(after.point(q) - before.point(q)), 1e-12) << type << ", " << size;
    }
}

TEST(ReadScene, RefusesAttributesThatItsPatchesDoNotHave) {
  const auto messageOf = [](const std::string& attribute, const std::string& attrib) -> std::string {
    const std::string text = "<X3D><Scene><Shape><ImageGeometry coord='a.png' vertexCount='3' attrib='" +
                             attrib + "'><FloatVertexAttribute " + attribute +
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

TEST(ReadScene, TakesX3domsDefaultsForABinaryGeometry) {
  const GeometryDescription geometry = readBinaryGeometry("coord='a' index='i'");
  EXPECT_EQ(geometry.coordType, ElementType::float32);
  EXPECT_EQ(geometry.indexType, ElementType::uint16);
  EXPECT_EQ(geometry.normalEncoding, NormalEncoding::rgb);
  EXPECT_EQ(geometry.patches[0].draws, (std::vector<Draw>{{Primitive::triangles, 0}}));
}

TEST(ReadScene, FindsX3domsSphericalNormalsInTheFourthElementOfCoordinates) {
  const std::string spherical = " coordType='Uint16' normalAsSphericalCoordinates='true'";
  for (const auto& [coord, normal] : {std::pair{"a.bin", Reference{"a.bin", 6, 8}},
                                      {"a.bin?+8", {"a.bin", 6, 8}},
                                      {"a.bin#24+32", {"a.bin", 30, 32}}}) {
    const GeometryDescription geometry =
        readBinaryGeometry(std::string("normal='ignored' coord='") + coord + "'" + spherical);
    EXPECT_EQ(geometry.normalEncoding, NormalEncoding::spherical);
    EXPECT_EQ(geometry.normalType, ElementType::uint8);
    EXPECT_EQ(geometry.patches[0].normal, normal);
  }
  EXPECT_THROW(readBinaryGeometry("coord='a' normalAsSphericalCoordinates='true'"), Error);
}

TEST(ReadScene, TakesIndicesOf16And32BitsFromImages) {
  const auto read = [](const std::string& type) {
    return readScene("<X3D><Scene><Shape><ImageGeometry indexType='" + type +
                         "' coord='a' index='i'/></Shape></Scene></X3D>",
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
    return readScene("<X3D><Scene><Group DEF='statue' bboxSize='3 3 3'>" + shapes + "</Group></Scene></X3D>",
                     "x");
  };
  const SceneDocument joined = scene(shape("DEF='A'", "a") + shape("USE='A'", "b"));
  ASSERT_EQ(joined.shapes.size(), 1u);
  EXPECT_EQ(joined.shapes[0].name, "statue");
  EXPECT_EQ(joined.shapes[0].material.diffuseColor, (Vec3f{1, 0, 0}));
  ASSERT_EQ(joined.geometries.at(0).patches.size(), 2u);
  EXPECT_EQ(joined.geometries[0].patches[1].coord[0].url, "b");
  EXPECT_EQ(joined.geometries[0].patches[1].box.size(), (Vec3d{1, 1, 1}));
  EXPECT_EQ(joined.geometries[0].box.size(), (Vec3d{3, 3, 3}));

  EXPECT_EQ(scene(shape("DEF='A'", "a") + shape("DEF='B'", "b")).shapes.size(), 2u);
  EXPECT_EQ(scene(shape("", "a") + shape("", "b")).shapes.size(), 2u);
  const std::string otherBox =
      "<Shape><Appearance USE='A'/><BinaryGeometry size='3 3 3' coordType='Uint16' coord='b'/></Shape>";
  EXPECT_EQ(scene(shape("DEF='A'", "a") + otherBox).shapes.size(), 2u);
  EXPECT_EQ(kindOfReading("<X3D><Scene>" + shape("USE='A'", "a") + "</Scene></X3D>"), ErrorKind::malformed);
}

TEST(ReadScene, RefusesGeometryThatNoLatticeStandsFor) {
  const auto geometry = [](const std::string& fields, const std::string& coord) {
    return "<X3D><Scene><Shape><ImageGeometry " + fields + " coord='" + coord + "'/></Shape></Scene></X3D>";
  };
  EXPECT_EQ(kindOfReading(geometry("size='1 -2 1'", "a")), ErrorKind::malformed);
  EXPECT_EQ(kindOfReading(geometry("size='0 0 0'", "a")), ErrorKind::malformed);
  EXPECT_EQ(kindOfReading(geometry("positionBits='16'", "a")), ErrorKind::malformed);
  EXPECT_EQ(kindOfReading(geometry("positionBits='7'", "a")), ErrorKind::malformed);
  EXPECT_EQ(kindOfReading(geometry("", "\"a\" \"b\" \"c\" \"d\" \"e\"")), ErrorKind::unsupported);
  EXPECT_EQ(kindOfReading(geometry("primType='TRIANGLEFAN' vertexCount='3'", "a")), ErrorKind::unsupported);
  EXPECT_EQ(kindOfReading(geometry("", "")), ErrorKind::malformed);
  EXPECT_EQ(kindOfReading("<X3D><Scene><Shape><Box/></Shape></Scene></X3D>"), ErrorKind::unsupported);
  EXPECT_EQ(kindOfReading("<X3D><Scene><Transform><Shape/></Transform></Scene></X3D>"),
            ErrorKind::unsupported);
}

TEST(ReadScene, RefusesADepthThatNobodyWrites) {
  std::string text = "<X3D><Scene>";
  for (int i = 0; i < 100000; ++i)
    text += "<Group>";
  for (int i = 0; i < 100000; ++i)
    text += "</Group>";
  EXPECT_EQ(kindOfReading(text + "</Scene></X3D>"), ErrorKind::limit);
}

TEST(ReadScene, RefusesEveryBeginningOfAText) {
  const std::string x3d = writeX3d(randomDocument(11));
  for (std::size_t length = 0; length < x3d.size() - 1; ++length) // the last byte is a line end
    EXPECT_THROW(readScene(std::string_view(x3d).substr(0, length), "x"), Error) << length;
}

} // namespace
} // namespace imgeo
