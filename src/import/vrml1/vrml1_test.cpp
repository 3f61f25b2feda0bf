// Compares scenes of VRML 1.0 with the X3D documents that show the same.

#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"
#include "import/vrml1/translator.h"
#include "scene/testing.h"

#include <gtest/gtest.h>
#include <sstream>

namespace imgeo::testing {
namespace {

std::string withHeader(const std::string& scene) {
  return "#VRML V1.0 ascii\n" + scene;
}

/// The translated document without <X3D> and <Scene>.
std::string translated(const std::string& scene, std::vector<std::string>* warnings = nullptr) {
  const std::string text = withHeader(scene);
  x3d::Elements elements = vrml1::readVrml1(text, "a.wrl", false);
  std::ostringstream out;
  for (const pugi::xml_node& child : elements.root().child("Scene").children())
    child.print(out, "", pugi::format_raw);
  if (warnings)
    *warnings = elements.warnings;
  return out.str();
}

Imported imported(const std::string& scene, const ImportOptions& options = {}) {
  return importBytes(asBytes(withHeader(scene)), "a.wrl", options);
}

const std::string gray = "<Appearance><Material/></Appearance>";

std::string boxOf(const std::string& appearance, const std::string& size = "2 2 2") {
  return "<Shape>" + appearance + "<Box size=\"" + size + "\"/></Shape>";
}

TEST(Vrml1, AppliesPropertiesToTheShapesAfterThemWithinASeparator) {
  EXPECT_EQ(
      translated("Separator { Cube { } Separator { Material { diffuseColor 1 0 0 } Cube { width 4 } } Cube { } }"),
      "<Group>" + boxOf("<Appearance DEF=\"Appearance\"><Material/></Appearance>") +
          boxOf("<Appearance><Material diffuseColor=\"1 0 0\"/></Appearance>", "4 2 2") +
          boxOf("<Appearance USE=\"Appearance\"/>") + "</Group>");
}

TEST(Vrml1, LeaksTheStateOfAGroupButNotTheTransformOfATransformSeparator) {
  EXPECT_EQ(translated("Group { Material { shininess .5 } Translation { translation 1 0 0 } } Sphere { radius 3 }"),
            "<Transform translation=\"1 0 0\"><Shape><Appearance><Material shininess=\"0.5\"/></Appearance>"
            "<Sphere radius=\"3\"/></Shape></Transform>");
  EXPECT_EQ(translated("TransformSeparator { Material { shininess .5 } Translation { translation 1 0 0 } } Cube { }"),
            boxOf("<Appearance><Material shininess=\"0.5\"/></Appearance>"));
}

TEST(Vrml1, WritesOneTransformForTranslationRotationAndScale) {
  EXPECT_EQ(
      translated("Translation { translation 1 2 3 } Translation { translation 1 0 0 } Rotation { rotation 0 1 0 .5 } "
                 "Scale { scaleFactor 1 2 1 } Cube { } Cube { }"),
      "<Transform translation=\"2 2 3\" rotation=\"0 1 0 0.5\" scale=\"1 2 1\">" +
          boxOf("<Appearance DEF=\"Appearance\"><Material/></Appearance>") + boxOf("<Appearance USE=\"Appearance\"/>") +
          "</Transform>");
}

TEST(Vrml1, KeepsTheShearOfAMatrix) {
  const Imported sheared =
      imported("MatrixTransform { matrix 1 0 0 0  .5 1 0 0  0 0 1 0  3 0 0 1 } "
               "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } IndexedFaceSet { coordIndex [0 1 2] }");
  const SceneGraph& graph = sheared.scene.graph;
  const Affine3d matrix = affineOf(std::get<Transform>(graph.nodes[graph.roots.at(0)].content));
  EXPECT_LT(length(matrix.point({0, 1, 0}) - Vec3d{3.5, 1, 0}), 1e-6);
  EXPECT_LT(length(matrix.point({1, 0, 1}) - Vec3d{4, 0, 1}), 1e-6);
}

TEST(Vrml1, UsesANamedSeparatorAgainWhereItReadsTheSameProperties) {
  EXPECT_EQ(translated("DEF Seat Separator { Material { } Cube { } } Translation { translation 1 0 0 } "
                       "Material { diffuseColor 1 0 0 } USE Seat"),
            "<Group DEF=\"Seat\">" + boxOf(gray) +
                "</Group><Transform translation=\"1 0 0\"><Group USE=\"Seat\"/></Transform>");
}

TEST(Vrml1, TranslatesAUseUnderOtherPropertiesAnew) {
  EXPECT_EQ(translated("DEF Seat Separator { Cube { } } Material { diffuseColor 1 0 0 } USE Seat"),
            "<Group DEF=\"Seat\">" + boxOf(gray) + "</Group><Group DEF=\"Seat-2\">" +
                boxOf("<Appearance><Material diffuseColor=\"1 0 0\"/></Appearance>") + "</Group>");
}

TEST(Vrml1, GivesEachShapeTheCoordinatesThatItUses) {
  EXPECT_EQ(translated("Coordinate3 { point [0 0 0, 1 0 0, 0 1 0, 0 0 5, 1 1 5, 2 2 5] } ShapeHints { vertexOrdering "
                       "CLOCKWISE shapeType SOLID } IndexedFaceSet { coordIndex [5, 3, 4, -1] }"),
            "<Shape>" + gray +
                "<IndexedFaceSet ccw=\"false\" creaseAngle=\"0.5\" coordIndex=\"2 0 1 -1\">"
                "<Coordinate point=\"0 0 5 1 1 5 2 2 5\"/></IndexedFaceSet></Shape>");
}

const std::string quads = "Coordinate3 { point [0 0 0, 1 0 0, 1 1 0, 0 1 0, 2 0 0, 2 1 0] } "
                          "Material { diffuseColor [1 0 0, 0 1 0, 0 0 1] } ";

/// The attributes and children of the only geometry, without its coordinates.
std::string colorsOf(const std::string& scene) {
  const std::string text = translated(scene);
  const std::size_t begin = text.find("coordIndex"), end = text.find("</Indexed");
  EXPECT_NE(begin, text.npos) << text;
  std::string geometry = text.substr(begin, end - begin);
  const std::size_t coordinate = geometry.find("<Coordinate");
  return geometry.erase(coordinate, geometry.find("/>", coordinate) + 2 - coordinate);
}

TEST(Vrml1, BindsMaterialsToFacesAndVertices) {
  const std::string faces = "IndexedFaceSet { coordIndex [0 1 2 3 -1 1 4 5 2] ",
                    index = "coordIndex=\"0 1 2 3 -1 1 4 5 2 -1\"";
  const auto bound = [&](const std::string& binding, const std::string& materialIndex = "") {
    return colorsOf(quads + "MaterialBinding { value " + binding + " } " + faces + materialIndex + "}");
  };
  EXPECT_EQ(bound("OVERALL"), index + ">");
  const std::string byFace = " colorPerVertex=\"false\">";
  EXPECT_EQ(bound("PER_FACE"), index + " colorIndex=\"0 1\"" + byFace + "<Color color=\"1 0 0 0 1 0\"/>");
  EXPECT_EQ(bound("PER_PART"), bound("PER_FACE"));
  EXPECT_EQ(bound("PER_FACE_INDEXED", "materialIndex [2 1] "),
            index + " colorIndex=\"1 0\"" + byFace + "<Color color=\"0 1 0 0 0 1\"/>");
  EXPECT_EQ(bound("PER_VERTEX"), // eight corners take the three materials in turn
            index + " colorIndex=\"0 1 2 0 -1 1 2 0 1 -1\"><Color color=\"1 0 0 0 1 0 0 0 1\"/>");
  EXPECT_EQ(bound("PER_VERTEX_INDEXED"),
            index + " colorIndex=\"0 1 2 0 -1 1 1 2 2 -1\"><Color color=\"1 0 0 0 1 0 0 0 1\"/>");
  EXPECT_EQ(bound("PER_VERTEX_INDEXED", "materialIndex [0 0 0 0 -1 1 1 1 1] "),
            index + " colorIndex=\"0 0 0 0 -1 1 1 1 1 -1\"><Color color=\"1 0 0 0 1 0\"/>");
}

TEST(Vrml1, SplitsFacesWhoseMaterialsDifferInMoreThanColor) {
  const std::string scene = "Coordinate3 { point [0 0 0, 1 0 0, 1 1 0, 0 1 0] } Material { diffuseColor [1 0 0, 0 1 0] "
                            "specularColor [0 0 0, 1 1 1] } ";
  const std::string faces = translated(scene + "MaterialBinding { value PER_FACE } "
                                               "IndexedFaceSet { coordIndex [0 1 2 -1 0 2 3 -1 0 1 3] }");
  EXPECT_NE(faces.find("coordIndex=\"0 1 2 -1 0 1 3 -1\""), faces.npos) << faces;
  EXPECT_NE(faces.find("<Material diffuseColor=\"0 1 0\" specularColor=\"1 1 1\"/>"), faces.npos) << faces;
  std::vector<std::string> warnings;
  translated(scene + "MaterialBinding { value PER_VERTEX } IndexedFaceSet { coordIndex [0 1 2] }", &warnings);
  EXPECT_EQ(warnings, (std::vector<std::string>{"The materials of 1 shape differ by vertex in more than diffuse colour "
                                                "and transparency; of the rest the first material counts."}));
}

TEST(Vrml1, WritesTransparencyThatVariesAsAlpha) {
  EXPECT_EQ(
      colorsOf("Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } Material { diffuseColor 1 1 0 transparency [0, .25] } "
               "MaterialBinding { value PER_FACE } IndexedFaceSet { coordIndex [0 1 2 -1 2 1 0] }"),
      "coordIndex=\"0 1 2 -1 2 1 0 -1\" colorIndex=\"0 1\" colorPerVertex=\"false\">"
      "<ColorRGBA color=\"1 1 0 1 1 1 0 0.75\"/>");
}

TEST(Vrml1, BindsMaterialsToPartsOfSolids) {
  EXPECT_EQ(translated("Material { diffuseColor [1 0 0, 0 1 0] } MaterialBinding { value PER_PART } Cone { }"),
            "<Shape><Appearance><Material diffuseColor=\"1 0 0\"/></Appearance><Cone bottom=\"false\"/></Shape>"
            "<Shape><Appearance><Material diffuseColor=\"0 1 0\"/></Appearance><Cone side=\"false\"/></Shape>");
  EXPECT_EQ(translated("Cylinder { parts (SIDES | TOP) radius 2 }"),
            "<Shape>" + gray + "<Cylinder radius=\"2\" bottom=\"false\" solid=\"false\"/></Shape>");
  const Imported cube =
      imported("Material { diffuseColor [1 0 0, 0 1 0] } MaterialBinding { value PER_FACE } Cube { }");
  ASSERT_EQ(cube.scene.meshes.size(), 6u);
  for (const Mesh& mesh : cube.scene.meshes) { // every face points away from the center
    const Vec3d a(mesh.positions[0]), b(mesh.positions[1]), c(mesh.positions[2]);
    EXPECT_GT(dot(cross(b - a, c - a), a), 0);
  }
}

TEST(Vrml1, BindsNormalsAndIgnoresTooFew) {
  const std::string face = "Coordinate3 { point [0 0 0, 1 0 0, 0 1 0] } Normal { vector [0 0 1, 1 0 0] } ";
  const auto normals = [&](const std::string& binding) {
    return translated(face + binding + "IndexedFaceSet { coordIndex [0 1 2] }");
  };
  EXPECT_NE(normals("NormalBinding { value OVERALL } ").find("<Normal vector=\"0 0 1\"/>"), std::string::npos);
  EXPECT_EQ(normals("").find("<Normal"), std::string::npos) << "three vertices need three normals";
  EXPECT_NE(normals("").find("creaseAngle=\"0.5\""), std::string::npos);
}

TEST(Vrml1, ColorsLinesAndPointsWithoutLight) {
  EXPECT_EQ(
      translated(
          "Coordinate3 { point [0 0 0, 1 0 0, 2 0 0] } Material { diffuseColor 0 1 0 } PointSet { startIndex 1 }"),
      "<Shape><Appearance><Material diffuseColor=\"0 0 0\" emissiveColor=\"0 1 0\"/></Appearance>"
      "<PointSet><Coordinate point=\"1 0 0 2 0 0\"/></PointSet></Shape>");
  EXPECT_EQ(colorsOf("Coordinate3 { point [0 0 0, 1 0 0, 2 0 0] } Material { diffuseColor [0 1 0, 1 0 0] } "
                     "MaterialBinding { value PER_PART } IndexedLineSet { coordIndex [0 1 2 -1] }"),
            "coordIndex=\"0 1 -1 1 2 -1\" colorIndex=\"0 1\" colorPerVertex=\"false\"><Color color=\"0 1 0 1 0 0\"/>");
}

TEST(Vrml1, TexturesWithTransformedAndWithDefaultCoordinates) {
  const std::string scene = "Coordinate3 { point [0 0 0, 4 0 0, 4 0 2] } Texture2 { filename wood.png wrapT CLAMP } ";
  EXPECT_EQ(
      translated(scene + "Texture2Transform { scaleFactor 2 2 center .5 .5 } IndexedFaceSet { coordIndex [0 1 2] }"),
      "<Shape><Appearance><Material/><ImageTexture url=\"&quot;wood.png&quot;\" repeatT=\"false\"/>"
      "<TextureTransform translation=\"-0.25 -0.25\" scale=\"2 2\"/></Appearance>"
      "<IndexedFaceSet solid=\"false\" creaseAngle=\"0.5\" coordIndex=\"0 1 2 -1\"><Coordinate point=\"0 0 0 4 0 0 4 0 "
      "2\"/>"
      "<TextureCoordinate point=\"0 0 1 0 1 0.5\"/></IndexedFaceSet></Shape>");
  EXPECT_EQ(translated(scene + "Texture2 { } Cube { }"), boxOf(gray)) << "an empty Texture2 ends the texture";
}

TEST(Vrml1, LightsOnlyWhatFollows) {
  EXPECT_EQ(
      translated("Sphere { } Rotation { rotation 0 1 0 1.5707963 } DirectionalLight { direction 0 0 -2 } Cube { }"),
      "<Shape><Appearance DEF=\"Appearance\"><Material/></Appearance><Sphere/></Shape>"
      "<Group><DirectionalLight direction=\"-2 0 -5.3589793e-08\" global=\"false\"/>"
      "<Transform rotation=\"0 1 0 1.5707963\">" +
          boxOf("<Appearance USE=\"Appearance\"/>") + "</Transform></Group><NavigationInfo headlight=\"false\"/>");
}

TEST(Vrml1, ReadsCamerasAndTheNamesThatBrowsersAgreedOn) {
  EXPECT_EQ(
      translated("DEF Title Info { string \"City\" } DEF BackgroundColor Info { string \"0 0 1\" } "
                 "DEF Viewer Info { string \"walk\" } Info { string \"by me\" } DEF Cameras Switch { whichChild 1 "
                 "DEF A PerspectiveCamera { position 0 0 9 } DEF B OrthographicCamera { height 4 focalDistance 3 } }"),
      "<Background skyColor=\"0 0 1\"/><NavigationInfo type=\"&quot;WALK&quot; &quot;ANY&quot;\"/>"
      "<WorldInfo title=\"City\" info=\"&quot;by me&quot;\"/>"
      "<OrthoViewpoint DEF=\"B\" description=\"B\" position=\"0 0 1\" centerOfRotation=\"0 0 -2\" "
      "fieldOfView=\"-2 -2 2 2\"/><Viewpoint DEF=\"A\" description=\"A\" position=\"0 0 9\" "
      "fieldOfView=\"0.785398\"/>");
}

TEST(Vrml1, KeepsSwitchesAnchorsAndLevelsOfDetail) {
  const std::string a = "<Shape><Appearance DEF=\"Appearance\"><Material/></Appearance><Sphere/></Shape>",
                    b = boxOf("<Appearance USE=\"Appearance\"/>");
  EXPECT_EQ(translated("Switch { whichChild 1 Sphere { } Cube { } }"),
            "<Switch whichChoice=\"1\">" + a + b + "</Switch>");
  EXPECT_EQ(translated("LOD { range [5, 9] center 0 1 0 Sphere { } Info { } Cube { } }"),
            "<LOD range=\"5 9\" center=\"0 1 0\">" + a + "<Group/>" + b + "</LOD>");
  EXPECT_EQ(translated("WWWAnchor { name \"a.html\" description \"A\" Sphere { } }"),
            "<Anchor url=\"&quot;a.html&quot;\" description=\"A\"><Shape>" + gray + "<Sphere/></Shape></Anchor>");
  EXPECT_EQ(translated("Switch { whichChild 0 Material { diffuseColor 1 0 0 } Material { } } Cube { }"),
            boxOf("<Appearance><Material diffuseColor=\"1 0 0\"/></Appearance>"));
}

TEST(Vrml1, WritesTextInTheCurrentFont) {
  EXPECT_EQ(translated("FontStyle { size 2 family SANS style (BOLD | ITALIC) } "
                       "AsciiText { string [\"a \\\"b\\\"\", caf\xe9] justification CENTER }"),
            "<Shape>" + gray +
                "<Text string=\"&quot;a \\&quot;b\\&quot;&quot; &quot;caf\xc3\xa9&quot;\"><FontStyle size=\"2\" "
                "family=\"&quot;SANS&quot;\" style=\"BOLDITALIC\" justify=\"&quot;MIDDLE&quot;\"/></Text></Shape>");
}

TEST(Vrml1, ReadsExtensionsAndUnknownNodes) {
  std::vector<std::string> warnings;
  EXPECT_EQ(translated("Die { fields [ SFFloat width, SFLong dots, MFString isA ] isA [ \"Cube\" ] width 4 dots 6 } "
                       "Complexity { value .5 mode (A|B) part DEF P Sphere { } } USE P",
                       &warnings),
            boxOf("<Appearance DEF=\"Appearance\"><Material/></Appearance>", "4 2 2") +
                "<Shape DEF=\"P\"><Appearance USE=\"Appearance\"/><Sphere/></Shape>"
                "<Shape DEF=\"P-2\"><Appearance USE=\"Appearance\"/><Sphere/></Shape>");
  EXPECT_EQ(warnings, (std::vector<std::string>{
                          "Nodes that VRML 1.0 does not have, of which only the child nodes are read: Complexity (1).",
                          "Fields that VRML 1.0 does not have are left out: Cube.dots (1)."}));
}

TEST(Vrml1, LeavesDamageOutAndNamesItsLocation) {
  const std::string damaged =
      "USE Nothing\nCoordinate3 { point [0 0 0, 1 0 0] }\nIndexedFaceSet { coordIndex [0 1 7] }";
  EXPECT_EQ(imported("Sphere { }\n" + damaged).warnings,
            (std::vector<std::string>{"a.wrl:3:1: left out: USE Nothing names no DEF.",
                                      "a.wrl:5:1: IndexedFaceSet: left out: names point 7 of 2."}));
  try {
    imported(damaged, {.attributes = {}, .strict = true});
    ADD_FAILURE() << "is not refused";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "a.wrl:2:1: left out: USE Nothing names no DEF");
  }
  const auto expect = [](const std::string& text, ErrorKind kind, const std::string& location) {
    const Error error = errorOf(withHeader(text), "a.wrl");
    EXPECT_EQ(error.kind(), kind) << text;
    EXPECT_EQ(error.location(), "a.wrl:" + location) << text << error.what();
  };
  expect("Separator { Cube { width", ErrorKind::truncated, "2:25");
  expect("Separator {\n  ]\n}", ErrorKind::malformed, "3:3");
  expect("Cube { width 1e99 }", ErrorKind::malformed, "2:14");
  expect("Cube { width 4x }", ErrorKind::malformed, "2:14");
}

TEST(Vrml1, RefusesUsesThatRepeatWithoutEnd) {
  std::string bomb = "DEF G0 Group { Cube { } }\n";
  for (int i = 1; i < 60; ++i)
    bomb += "DEF G" + std::to_string(i) + " Group { USE G" + std::to_string(i - 1) + " USE G" + std::to_string(i - 1) +
            " }\n";
  EXPECT_EQ(errorOf(withHeader(bomb), "a.wrl").kind(), ErrorKind::limit);
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "Separator { ";
  EXPECT_EQ(errorOf(withHeader(deep), "a.wrl").kind(), ErrorKind::limit);
}

TEST(Vrml1, IsReadAsAnInlineOfEveryVersion) {
  const TemporaryDirectory directory;
  writeFile(directory / "part.wrl", asBytes(withHeader("Sphere { }")));
  writeFile(directory / "old.wrl", asBytes(withHeader("WWWInline { name \"part.wrl\" bboxSize 2 2 2 }")));
  writeFile(directory / "new.wrl", asBytes("#VRML V2.0 utf8\nInline { url \"part.wrl\" }"));
  for (const char* file : {"old.wrl", "new.wrl"}) {
    const SceneGraph graph = importFile(directory / file).scene.graph;
    const Node& node = graph.nodes[graph.roots.at(0)];
    EXPECT_EQ(std::get<GenericNode>(node.content).element, "Inline");
    EXPECT_EQ(std::get<GenericNode>(graph.nodes[node.children.at(0)].content).element, "Shape") << file;
  }
}

TEST(Vrml1, ReadsLineEndsOfDosAndMac) {
  const std::string scene = "#VRML V1.0 ascii\n# a note\nSeparator {\n  Cube { }\n}\n";
  for (const std::string end : {"\r\n", "\r"}) {
    std::string text;
    for (const char c : scene)
      text += c == '\n' ? end : std::string(1, c);
    const Imported read = importBytes(asBytes(text), "a.wrl");
    EXPECT_EQ(read.format, "VRML 1.0");
    EXPECT_EQ(read.scene.graph.roots.size(), 2u) << "the note and the shape";
  }
}

} // namespace
} // namespace imgeo::testing
