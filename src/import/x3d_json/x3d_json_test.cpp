// Compares the scenes of JSON texts and of their equivalents in XML encoding.

#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

std::string documentOf(const std::string& children) {
  return R"({ "X3D": { "encoding": "UTF-8", "@version": "4.0", "@profile": "Immersive", "Scene": {
"-children": [)" +
         children + "] } } }";
}

Imported readJson(const std::string& children) {
  return importBytes(asBytes(documentOf(children)), "a.x3dj");
}

/// Expects that both texts give equal scenes.
void expectSameScene(const std::string& json, const std::string& xml) {
  const Scene a = readJson(json).scene,
              b = importBytes(asBytes("<X3D version='4.0' profile='Immersive'><Scene>" + xml + "</Scene></X3D>"),
                              "a.x3d")
                      .scene;
  ASSERT_EQ(a.graph.nodes.size(), b.graph.nodes.size()) << json;
  for (std::size_t i = 0; i < a.graph.nodes.size(); ++i)
    EXPECT_EQ(a.graph.nodes[i], b.graph.nodes[i]) << "node " << i << " of " << json;
  EXPECT_EQ(a.graph.roots, b.graph.roots);
  EXPECT_EQ(a.graph.head.fields, b.graph.head.fields);
  ASSERT_EQ(a.meshes.size(), b.meshes.size());
  for (std::size_t i = 0; i < a.meshes.size(); ++i) {
    EXPECT_EQ(a.meshes[i].positions, b.meshes[i].positions);
    EXPECT_EQ(a.meshes[i].corners, b.meshes[i].corners);
  }
}

TEST(X3dJson, EqualsTheSameSceneInXmlEncoding) {
  expectSameScene(R"({"#comment": "a seat"},
{"Transform": {"@DEF": "Seat", "@translation": [1, 2, 3], "@rotation": [0, 1, 0, 1.5], "-children": [
  {"Shape": {
    "-appearance": {"Appearance": {"-material": {"Material": {"@DEF": "Red", "@diffuseColor": [1, 0, 0]}}}},
    "-geometry": {"IndexedFaceSet": {"@solid": false, "@coordIndex": [0, 1, 2, -1],
      "-coord": {"Coordinate": {"@point": [0, 0, 0, 1, 0, 0, 0, 1.5e0, 0]}}}}}}]}},
{"Transform": {"-children": [{"Transform": {"@USE": "Seat"}}]}})",
                  "<!--a seat--><Transform DEF='Seat' translation='1 2 3' rotation='0 1 0 1.5'>"
                  "<Shape><Appearance><Material DEF='Red' diffuseColor='1 0 0'/></Appearance>"
                  "<IndexedFaceSet solid='false' coordIndex='0 1 2 -1'><Coordinate point='0 0 0 1 0 0 0 1.5e0 0'/>"
                  "</IndexedFaceSet></Shape></Transform><Transform><Transform USE='Seat'/></Transform>");
}

TEST(X3dJson, KeepsStringsListsAndBooleans) {
  expectSameScene(R"({"WorldInfo": {"@title": "a \"b\" \\ c", "@info": ["one", "t\"wo"]}},
{"NavigationInfo": {"@type": ["WALK", "ANY"], "@headlight": false, "@avatarSize": []}},
{"Background": {"@skyColor": [[1, 0, 0], [0, 1, 0]]}}, {"Anchor": {"url": ["a.html"], "-children": []}})",
                  R"(<WorldInfo title='a "b" \ c' info='"one" "t\"wo"'/><NavigationInfo type='"WALK" "ANY"')"
                  R"( headlight='false' avatarSize=''/><Background skyColor='1 0 0 0 1 0'/><Anchor url='"a.html"'/>)");
}

TEST(X3dJson, SetsTheContainerFieldOfNodes) {
  expectSameScene(R"({"Shape": {"-appearance": {"Appearance": {"-material": {"PhysicalMaterial": {
"-baseTexture": {"ImageTexture": {}}}}}}}}, {"Collision": {"-proxy": {"Group": {}}}})",
                  "<Shape><Appearance><PhysicalMaterial><ImageTexture containerField='baseTexture'/></PhysicalMaterial>"
                  "</Appearance></Shape><Collision><Group containerField='proxy'/></Collision>");
}

TEST(X3dJson, ReadsHeadRoutesAndScripts) {
  const Imported imported = importBytes(asBytes(R"({"X3D": {"@version": "3.3", "JSON schema": "http://a.org/x.json",
"head": {"meta": [{"@name": "creator", "@content": "somebody"}, {"@name": "b", "@content": "c"}],
  "component": {"@name": "Text", "@level": 1}},
"Scene": {"-children": [{"TimeSensor": {"@DEF": "T"}}, {"TimeSensor": {"@DEF": "U"}},
  {"Script": {"@DEF": "S", "field": [{"@name": "n", "@type": "SFNode", "@accessType": "initializeOnly",
     "-children": [{"Shape": {"-geometry": {"Box": {}}}}]}], "#sourceCode": ["ecmascript:", "x = 1"]}},
  {"ROUTE": {"@fromNode": "T", "@fromField": "time", "@toNode": "U", "@toField": "startTime"}}]}}})"),
                                        "a.json");
  EXPECT_EQ(imported.format, "X3D JSON");
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.head.header.size(), 3u);
  EXPECT_EQ(graph.nodes[graph.head.header[0]].fields,
            (std::vector<FieldText>{{"name", "creator"}, {"content", "somebody"}}));
  EXPECT_EQ(graph.roots.size(), 2u);
  EXPECT_EQ(graph.routes, (std::vector<Route>{{graph.roots[0], "time", graph.roots[1], "startTime"}}));
  EXPECT_EQ(imported.warnings.at(0), "Script (1) left out, since pages run no scripts; it is at a.json:5:5.");
}

TEST(X3dJson, ExpandsPrototypes) {
  expectSameScene(R"({"ProtoDeclare": {"@name": "P", "ProtoInterface": {"field": [
  {"@name": "c", "@type": "SFColor", "@accessType": "inputOutput", "@value": [1, 1, 1]},
  {"@name": "g", "@type": "SFNode", "@accessType": "inputOutput", "-children": [{"Sphere": {}}]}]},
"ProtoBody": {"-children": [{"Shape": {"IS": {"connect": [{"@nodeField": "geometry", "@protoField": "g"}]},
  "-appearance": {"Appearance": {"-material": {"Material": {
    "IS": {"connect": {"@nodeField": "diffuseColor", "@protoField": "c"}}}}}}}}]}}},
{"ProtoInstance": {"@name": "P", "fieldValue": [{"@name": "c", "@value": [0, 1, 0]},
  {"@name": "g", "-children": [{"Box": {}}]}]}}, {"ProtoInstance": {"@name": "P"}})",
                  "<Shape><Appearance><Material diffuseColor='0 1 0'/></Appearance><Box/></Shape>"
                  "<Shape><Appearance><Material diffuseColor='1 1 1'/></Appearance><Sphere/></Shape>");
}

TEST(X3dJson, NamesTheLocationOfAnError) {
  const auto expect = [](const std::string& text, ErrorKind kind, const std::string& location) {
    const Error error = errorOf(text, "a.x3dj");
    EXPECT_EQ(error.kind(), kind) << text;
    EXPECT_EQ(error.location(), "a.x3dj" + location) << text << error.what();
  };
  expect("{\"X3D\": {\n\"Scene\": {]}}", ErrorKind::malformed, ":2:11");
  expect("{\"X3D\": {\n\"Scene\": {\"-children\": [{\"Gr<up\": {}}]}}}", ErrorKind::malformed, ":2:27");
  expect("{\"X3D\": {\n\"Scene\": {\"-children\": [{\"Group\": {\"@bboxSize\": {}}}]}}}", ErrorKind::malformed,
         ":2:37");
  expect("{\"X3D\": {\n\"Scene\": 1e999}}", ErrorKind::malformed, ":2:14");
  expect("{\"X3D\": 3}", ErrorKind::malformed, "");
  expect("[]", ErrorKind::malformed, ":1:1");
  std::string deep;
  for (int i = 0; i < 100000; ++i)
    deep += R"({"Group": {"-children": [)";
  EXPECT_EQ(errorOf("{\"X3D\": {\"Scene\": {\"-children\": [" + deep, "a.x3dj").kind(), ErrorKind::limit);
  const Imported damaged = readJson("{\"Shape\": {\n\"-geometry\": {\"IndexedTriangleSet\": {\"@index\": [0, 1, 7],\n"
                                    "\"-coord\": {\"Coordinate\": {\"@point\": [0, 0, 0]}}}}}}");
  ASSERT_EQ(damaged.warnings.size(), 1u);
  EXPECT_NE(damaged.warnings[0].find("a.x3dj:3:16: IndexedTriangleSet: names position 1 of 1"), std::string::npos)
      << damaged.warnings[0];
}

TEST(X3dJson, IsReadAsAnInline) {
  const TemporaryDirectory directory;
  writeFile(directory / "part.json", asBytes(documentOf(R"({"Shape": {"-geometry": {"Box": {}}}})")));
  writeFile(directory / "a.x3d", asBytes("<X3D><Scene><Inline url='part.json'/></Scene></X3D>"));
  const Imported imported = importFile(directory / "a.x3d");
  EXPECT_TRUE(imported.warnings.empty());
  EXPECT_EQ(imported.scene.graph.inlined.size(), 1u);
}

} // namespace
} // namespace imgeo::testing
