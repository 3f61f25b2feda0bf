// Compares the scenes of VRML texts and of their equivalents in XML encoding.

#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

Imported readVrml(const std::string& scene) {
  return importBytes(asBytes("#VRML V2.0 utf8\n" + scene), "a.wrl");
}

Imported readXml(const std::string& scene) {
  return importBytes(asBytes("<X3D version='3.3' profile='Immersive'><Scene>" + scene + "</Scene></X3D>"), "a.wrl");
}

/// Expects that both texts give equal scenes.
void expectSame(const std::string& vrml, const std::string& xml) {
  const Scene a = readVrml(vrml).scene, b = readXml(xml).scene;
  ASSERT_EQ(a.graph.nodes.size(), b.graph.nodes.size()) << vrml;
  for (std::size_t i = 0; i < a.graph.nodes.size(); ++i)
    EXPECT_EQ(a.graph.nodes[i], b.graph.nodes[i]) << "node " << i << " of " << vrml;
  EXPECT_EQ(a.graph.roots, b.graph.roots);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
    EXPECT_EQ(a.meshes[i].corners, b.meshes[i].corners);
  }
}

Error errorOfText(const std::string& text) {
  return errorOf(text, "a.wrl");
}

TEST(Vrml, EqualsTheSameSceneInXmlEncoding) {
  expectSame("DEF Seat Transform { translation 1 2 3 rotation 0 1 0 +1.5 children [\n"
             "  Shape { appearance Appearance { material DEF Red Material { diffuseColor 1 0 0 } }\n"
             "          geometry IndexedFaceSet { solid FALSE coordIndex [0, 1, 2, -1] # one face\n"
             "            coord Coordinate { point [0 0 0, 1 0 0, 0 1.e0 -.0] } } } ] }\n"
             "Transform { children USE Seat }",
             "<Transform DEF='Seat' translation='1 2 3' rotation='0 1 0 +1.5'>"
             "<Shape><Appearance><Material DEF='Red' diffuseColor='1 0 0'/></Appearance>"
             "<IndexedFaceSet solid='false' coordIndex='0 1 2 -1'><!-- one face-->"
             "<Coordinate point='0 0 0 1 0 0 0 1 "
             "0'/></IndexedFaceSet></Shape></Transform><Transform><Transform USE='Seat'/></Transform>");
}

TEST(Vrml, KeepsStringsListsAndBooleans) {
  expectSame("WorldInfo { title \"a \\\"b\\\" \\\\ c\" info \"one\" }\n"
             "NavigationInfo { type [ \"WALK\", \"ANY\" ] headlight FALSE avatarSize [] }\n"
             "Anchor { url \"a.html\" children [] }",
             "<WorldInfo title='a \"b\" \\ c' info='\"one\"'/>"
             "<NavigationInfo type='\"WALK\" \"ANY\"' headlight='false' avatarSize=''/><Anchor url='\"a.html\"'/>");
}

TEST(Vrml, SetsTheContainerFieldOfNodes) {
  expectSame("Shape { appearance Appearance { material PhysicalMaterial { baseTexture ImageTexture { } } } }\n"
             "LOD { range [5] level [ Group { } Group { } ] } Switch { choice Group { } whichChoice 0 }\n"
             "Collision { collide FALSE proxy Group { } children NULL }",
             "<Shape><Appearance><PhysicalMaterial><ImageTexture containerField='baseTexture'/></PhysicalMaterial>"
             "</Appearance></Shape><LOD range='5'><Group/><Group/></LOD><Switch whichChoice='0'><Group/></Switch>"
             "<Collision enabled='false'><Group containerField='proxy'/></Collision>");
}

TEST(Vrml, KeepsRoutesAndLeavesOutScripts) {
  const std::string vrml =
      "DEF T TimeSensor { } DEF S Script { url \"javascript:x\" eventIn SFTime now field SFFloat k 2\n"
      "field SFNode n USE T directOutput TRUE } ROUTE T.time TO S.now DEF U TimeSensor { } ROUTE T.time TO U.startTime";
  expectSame(vrml, "<TimeSensor DEF='T'/><Script DEF='S'/><TimeSensor DEF='U'/>"
                   "<ROUTE fromNode='T' fromField='time' toNode='U' toField='startTime'/>");
  EXPECT_EQ(readVrml(vrml).warnings,
            (std::vector<std::string>{"Script (1) left out, since pages run no scripts; it is at a.wrl:2:28."}));
}

TEST(Vrml, LeavesOutUnknownNodesWithTheFieldsThatTheyDeclare) {
  const Imported imported = readVrml(
      "Shape { appearance Appearance {\n"
      "  material Material { diffuseColor 1 0 0 }\n"
      "  effects [ Effect { language \"GLSL\" inputOutput SFFloat k 0.5 exposedField MFNode n [ Group { } ]\n"
      "    initializeOnly SFNode map ImageTexture { } parts EffectPart { type \"FRAGMENT\" url \"a.fs\" } } ]\n"
      "} geometry Box { } }\n"
      "Strange { field SFVec3f size 1 2 3 eventIn SFBool on children [ DEF S Shape { geometry Sphere { } } ] }\n"
      "Group { children [ USE S ] }");
  EXPECT_EQ(imported.warnings,
            (std::vector<std::string>{
                "Effect (1) left out, since pages run no shaders of others; the material beside it is drawn; it is at "
                "a.wrl:4:13.",
                "Strange (1) left out, since it is no node of X3D 4.0; it is at a.wrl:7:1."}));
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.roots.size(), 2u);
  EXPECT_EQ(graph.nodes[graph.roots[1]].children.size(), 1u) << "the Sphere";
}

TEST(Vrml, ResolvesARepeatedNameToTheLatestNode) {
  const SceneGraph graph =
      readVrml("DEF A Group { } Transform { children USE A } DEF A Transform { } Group { children USE A }").scene.graph;
  const auto childOf = [&](std::size_t root) { return graph.nodes[graph.roots.at(root)].children.at(0); };
  EXPECT_EQ(childOf(1), graph.roots[0]);
  EXPECT_EQ(childOf(3), graph.roots[2]);
}

TEST(Vrml, ExpandsPrototypes) {
  const std::string vrml =
      "PROTO Chair [ field SFVec3f at 0 0 0 exposedField MFNode parts [ Group { } ] field SFColor paint 1 1 "
      "1 ] {\n"
      "  PROTO Look [ field SFColor tint 0 0 0 ] { Appearance { material Material { diffuseColor IS tint } } "
      "}\n"
      "  DEF Place Transform { translation IS at children [ Shape { appearance Look { tint IS paint } }\n"
      "    Group { children IS parts } Transform { children USE Place2 } DEF Place2 Group { } Group { "
      "children USE Place2 } ] }\n"
      "  PointLight { }\n"
      "}\n"
      "DEF First Chair { at 1 2 3 paint 0 1 0 } Chair { parts [ Chair { } ] }";
  const Imported imported = readVrml(vrml);
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.roots.size(), 2u);
  const Node& first = graph.nodes[graph.roots[0]];
  EXPECT_EQ(first.name, "First");
  EXPECT_EQ(std::get<Transform>(first.content).translation, (Vec3d{1, 2, 3}));
  const Node& shape = graph.nodes[first.children.at(0)];
  const Node& material = graph.nodes[graph.nodes[shape.children.at(0)].children.at(0)];
  EXPECT_EQ(material.fields, (std::vector<FieldText>{{"diffuseColor", "0 1 0"}}));
  const Node& second = graph.nodes[graph.roots[1]];
  const Node& parts = graph.nodes[second.children.at(1)];
  EXPECT_TRUE(std::holds_alternative<Transform>(graph.nodes[parts.children.at(0)].content)) << "a chair on a chair";
  EXPECT_EQ(graph.nodes[second.children.at(3)].name, "Place2-3");
  for (const Node& node : graph.nodes) {
    const GenericNode* other = std::get_if<GenericNode>(&node.content);
    EXPECT_FALSE(other && other->element.starts_with("Proto")) << other->element;
  }
  const std::string all = ::testing::PrintToString(imported.warnings);
  EXPECT_NE(all.find("6 instances of 2 prototypes are written out"), std::string::npos) << all;
  EXPECT_NE(all.find("Left out of prototypes: PointLight (1)."), std::string::npos) << all;
}

TEST(Vrml, ReadsExternalPrototypesOfTheInputsFolder) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "lib");
  writeFile(
      directory / "lib/doors.wrl",
      asBytes("#VRML V2.0 utf8\nPROTO Handle [ field SFFloat r 1 ] { Shape { geometry Sphere { radius IS r } } }\n"
              "PROTO Door [ field SFVec3f size 1 1 1 field MFNode parts [ ] ] { Group { children [\n"
              "  Shape { appearance Appearance { texture ImageTexture { url \"wood.png\" } }\n"
              "    geometry Box { size IS size } } Handle { r 2 } Group { children IS parts } ] } }"));
  writeFile(directory / "lib/wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto read = [&](const std::string& url, const std::string& format) {
    const bool isVrml = format == "wrl";
    writeFile(directory / ("a." + format),
              asBytes(isVrml ? "#VRML V2.0 utf8\nEXTERNPROTO Door [ field SFVec3f size field MFNode parts ] [ " + url +
                                   " ]\nDoor { size 1 2 3 parts [ Group { } ] }"
                             : "<X3D><Scene>\n<ExternProtoDeclare name='Door' url='" + url +
                                   "'/><ProtoInstance name='Door'><fieldValue name='size' value='1 2 3'/><fieldValue "
                                   "name='parts'><Group/></fieldValue></ProtoInstance></Scene></X3D>"));
    return importFile(directory / ("a." + format));
  };
  for (const char* format : {"wrl", "x3d"}) {
    const Imported imported = read("\"lost.wrl#Door\" \"lib/doors.wrl#Door\"", format);
    const SceneGraph& graph = imported.scene.graph;
    ASSERT_EQ(imported.warnings, std::vector<std::string>{
                                     "2 instances of 2 prototypes are written out as the nodes that they stand for."});
    const Node& door = graph.nodes[graph.roots.at(0)];
    ASSERT_EQ(door.children.size(), 3u);
    const Node& panel = graph.nodes[door.children[0]];
    EXPECT_EQ(graph.nodes[panel.children.at(1)].fields, (std::vector<FieldText>{{"size", "1 2 3"}}));
    EXPECT_EQ(graph.images.size(), 1u) << "its URL is relative to the prototype's file";
    const Node& handle = graph.nodes[door.children[1]];
    EXPECT_EQ(graph.nodes[handle.children.at(0)].fields, (std::vector<FieldText>{{"radius", "2"}}));
    EXPECT_EQ(graph.nodes[door.children[2]].children.size(), 1u);
  }
  const auto refused = [&](const std::string& url, const std::string& cause) {
    const Imported imported = read(url, "wrl");
    ASSERT_EQ(imported.warnings.size(), 2u);
    EXPECT_EQ(imported.warnings[0], "ProtoInstance (1) left out, since no prototype for it could be read; it is at " +
                                        (directory / "a.wrl").string() + ":3:1.");
    EXPECT_NE(imported.warnings[1].find("The instances of the external prototype Door are left out: "),
              std::string::npos);
    EXPECT_NE(imported.warnings[1].find(cause), std::string::npos) << imported.warnings[1];
    EXPECT_TRUE(imported.scene.graph.roots.empty());
  };
  refused("\"http://example.org/doors.wrl#Door\"", "example.org");
  refused("\"lib/doors.wrl#Window\"", "has no prototype Window");
  refused("\"../doors.wrl#Door\"", "outside");
  writeFile(directory / "lib/broken.wrl", asBytes("#VRML V2.0 utf8\nPROTO Door [ ] {\n ]"));
  refused("\"lib/broken.wrl#Door\"", (directory / "lib/broken.wrl").string() + ":3:2");
}

TEST(Vrml, RefusesPrototypesThatExpandTooFar) {
  std::string bomb = "PROTO P0 [] { Group { } }\n";
  for (int i = 1; i < 40; ++i)
    bomb += "PROTO P" + std::to_string(i) + " [] { Group { children [ P" + std::to_string(i - 1) + " {} P" +
            std::to_string(i - 1) + " {} ] } }\n";
  EXPECT_EQ(errorOfText("#VRML V2.0 utf8\n" + bomb + "P39 { }").kind(), ErrorKind::limit);
  const Imported recursive = readVrml("PROTO P [] { Group { children P { } } } P { }");
  EXPECT_LE(recursive.scene.graph.nodes.size(), 3u);
}

TEST(Vrml, ReadsTheClassicEncodingOfX3d) {
  const Imported imported =
      importBytes(asBytes("#X3D V3.2 utf8\nPROFILE Interchange\nCOMPONENT Text:1\nMETA \"creator\" \"somebody\"\n"
                          "UNIT length inch 0.0254\n"
                          "Shape { geometry TriangleSet { coord Coordinate { point [0 0 0 1 0 0 0 1 0] } } }"),
                  "a.x3dv");
  EXPECT_EQ(imported.format, "X3D Classic");
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
  ASSERT_EQ(imported.scene.graph.head.header.size(), 3u);
  EXPECT_EQ(imported.scene.graph.nodes[imported.scene.graph.head.header[1]].fields,
            (std::vector<FieldText>{{"name", "creator"}, {"content", "somebody"}}));
}

TEST(Vrml, NamesTheLocationOfAnError) {
  const auto expect = [](const std::string& text, ErrorKind kind, const std::string& location) {
    const Error error = errorOfText("#VRML V2.0 utf8\n" + text);
    EXPECT_EQ(error.kind(), kind) << text;
    EXPECT_EQ(error.location(), "a.wrl:" + location) << text << error.what();
  };
  expect("Group { children [", ErrorKind::truncated, "2:19");
  expect("Group {\n  children ]\n}", ErrorKind::malformed, "3:12");
  expect("WorldInfo { title \"a", ErrorKind::truncated, "2:19");
  expect("Group 'a", ErrorKind::malformed, "2:7");
  expect("Gr<up { }", ErrorKind::malformed, "2:1");
  expect("ROUTE a TO b.c", ErrorKind::malformed, "2:1");
  expect("}", ErrorKind::malformed, "2:1");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += "Group { children ";
  EXPECT_EQ(errorOfText("#VRML V2.0 utf8\n" + deep).kind(), ErrorKind::limit);
  EXPECT_EQ(errorOfText("Group { }").kind(), ErrorKind::malformed);
}

TEST(Vrml, LeavesDamagedContentOutAndNamesItsLocation) {
  const Imported imported = readVrml("Shape { geometry IndexedFaceSet {\n coordIndex [0 1 7] coord "
                                     "Coordinate { point [0 0 0 1 0 0 0 1 0] } } }\n"
                                     "Group { children USE Nothing }");
  ASSERT_EQ(imported.warnings.size(), 2u);
  EXPECT_NE(imported.warnings[0].find("a.wrl:2:18: IndexedFaceSet: names position 7 of 3"), std::string::npos)
      << imported.warnings[0];
  EXPECT_NE(imported.warnings[1].find("a.wrl:4:18"), std::string::npos) << imported.warnings[1];
}

} // namespace
} // namespace imgeo::testing
