#include "import/testing.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

namespace imgeo::x3d {
namespace {

Imported readScene(const std::string& nodes) {
  return importBytes(asBytes("<X3D><Scene>" + nodes + "</Scene></X3D>"), "a.x3d");
}

const std::string animation =
    "<TimeSensor DEF='T' cycleInterval='2' loop='true'/>"
    "<PositionInterpolator DEF='P' key='0 0.5 1' keyValue='0 0 0, 1 0 0, 0 0 0'/><Transform DEF='M'/>";

std::string route(const std::string& from, const std::string& to) {
  const auto end = [](const std::string& name, const std::string& text) {
    const std::size_t dot = text.find('.');
    return " " + name + "Node='" + text.substr(0, dot) + "' " + name + "Field='" + text.substr(dot + 1) + "'";
  };
  return "<ROUTE" + end("from", from) + end("to", to) + "/>";
}

std::size_t nodeNamed(const SceneGraph& graph, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(graph.nodes, name, &Node::name) - graph.nodes.begin());
}

TEST(Routes, ConnectNodesByTheirDef) {
  const Imported imported =
      readScene(animation + route("T.fraction_changed", "P.set_fraction") + route("P.value_changed", "M.translation") +
                route("P.value_changed", "M.translation"));
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::size_t sensor = nodeNamed(graph, "T"), interpolator = nodeNamed(graph, "P"), moved = nodeNamed(graph, "M");
  EXPECT_EQ(graph.routes, (std::vector<Route>{{sensor, "fraction_changed", interpolator, "set_fraction"},
                                              {interpolator, "value_changed", moved, "translation"}}));
  EXPECT_EQ(std::get<TimeSensor>(graph.nodes[sensor].content).cycleInterval, 2);
  EXPECT_TRUE(std::get<TimeSensor>(graph.nodes[sensor].content).loop);
  EXPECT_EQ(std::get<Interpolator>(graph.nodes[interpolator].content),
            (Interpolator{InterpolatorKind::position, {0, 0.5, 1}, {0, 0, 0, 1, 0, 0, 0, 0, 0}}));
}

TEST(Routes, ToNothingOrOfWrongTypesAreLeftOutWithOneWarningEach) {
  const auto expect = [](const std::string& from, const std::string& to, const std::string& warning) {
    const Imported imported = readScene(animation + "<TouchSensor DEF='S'/>" + route(from, to));
    EXPECT_EQ(imported.warnings, std::vector<std::string>{"Left out: a.x3d:1:" + std::to_string(36 + animation.size()) +
                                                          ": ROUTE: " + warning + "."});
    EXPECT_TRUE(imported.scene.graph.routes.empty());
  };
  expect("T.time", "X.set_fraction", "no node has the DEF \"X\"");
  expect("T.foo", "P.set_fraction", "a TimeSensor has no field \"foo\" for routes");
  expect("T.", "P.set_fraction", "a TimeSensor has no field \"\" for routes");
  expect("T.time", "P.set_fraction", "time of \"T\" is of type SFTime, set_fraction of \"P\" of type SFFloat");
  expect("P.value_changed", "M.rotation",
         "value_changed of \"P\" is of type SFVec3f, rotation of \"M\" of type SFRotation");
  expect("P.set_fraction", "P.set_fraction", "set_fraction of \"P\" only takes events");
  expect("S.isOver", "S.isActive", "isActive of \"S\" only sends events");
}

TEST(Routes, ToImportedNodesAreKeptAsTheyAre) {
  const Imported imported =
      readScene(animation +
                "<Inline DEF='I' url='https://example.org/m.x3d'/><IMPORT inlineDEF='I' importedDEF='door' "
                "AS='gate'/>" +
                route("P.value_changed", "gate.set_translation") + route("P.value_changed", "M.translation"));
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(graph.routes.size(), 1u);
  const auto kept = std::ranges::find_if(graph.nodes, [](const Node& node) {
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    return generic && generic->element == "ROUTE";
  });
  ASSERT_NE(kept, graph.nodes.end());
  EXPECT_EQ(kept->fields.at(2).value, "gate");
  for (const std::string& warning : imported.warnings)
    EXPECT_EQ(warning.find("ROUTE"), std::string::npos) << warning;
}

TEST(Routes, KeepGeometryWhoseCoordinatesAreExported) {
  const std::string shape = "<Shape><TriangleSet><Coordinate DEF='C' point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape>";
  EXPECT_EQ(readScene(shape).scene.meshes.size(), 1u);
  EXPECT_TRUE(readScene(shape + "<EXPORT localDEF='C'/>").scene.meshes.empty());
}

TEST(Routes, KeepGeometryWhoseCoordinatesTheyMove) {
  const std::string shape = "<Shape><TriangleSet><Coordinate DEF='C' point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape>",
                    interpolator = "<CoordinateInterpolator DEF='I' key='0' keyValue='0 0 0 1 0 0 0 1 0'/>";
  EXPECT_EQ(readScene(shape + interpolator).scene.meshes.size(), 1u);
  const Imported moved = readScene(shape + interpolator + route("I.value_changed", "C.point"));
  EXPECT_TRUE(moved.scene.meshes.empty());
  EXPECT_EQ(moved.scene.graph.routes.size(), 1u);
  EXPECT_TRUE(moved.warnings.empty()) << ::testing::PrintToString(moved.warnings);
}

TEST(Routes, OfPrototypesConnectTheNodesOfEachInstance) {
  const Imported imported = readScene(
      "<ProtoDeclare name='Door'><ProtoInterface><field name='swing' type='SFRotation' accessType='inputOutput'/>"
      "</ProtoInterface><ProtoBody><Group><Transform DEF='Wing'><IS><connect nodeField='rotation' protoField='swing'/>"
      "</IS></Transform></Group><TimeSensor DEF='Clock' loop='true'/>"
      "<PositionInterpolator DEF='Slide' key='0 1' keyValue='0 0 0 1 0 0'/>" +
      route("Clock.fraction_changed", "Slide.set_fraction") + route("Slide.value_changed", "Wing.translation") +
      "</ProtoBody></ProtoDeclare><ProtoInstance name='Door' DEF='First'/><ProtoInstance name='Door' DEF='Second'/>"
      "<OrientationInterpolator DEF='O' key='0' keyValue='0 1 0 1'/>" +
      route("O.value_changed", "Second.set_swing"));
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings); // instances are written out
  EXPECT_EQ(countNodes<TimeSensor>(graph), 2u);
  std::vector<std::string> texts;
  for (const Route& each : graph.routes)
    texts.push_back(graph.nodes[each.fromNode].name + "." + each.fromField + " " + graph.nodes[each.toNode].name + "." +
                    each.toField);
  std::ranges::sort(texts);
  EXPECT_EQ(texts, (std::vector<std::string>{
                       "Clock-2.fraction_changed Slide-2.set_fraction", "Clock.fraction_changed Slide.set_fraction",
                       "O.value_changed Wing-2.rotation", "Slide-2.value_changed Wing-2.translation",
                       "Slide.value_changed Wing.translation"}));
}

TEST(Interpolators, WhoseDefIsInAnElementThatIsLeftOutAreReadWhereTheyAreUsed) {
  const std::string fields = " DEF='I' key='0 1' keyValue='2 3'";
  const Imported imported = readScene("<TimeSensor DEF='T'/><Unknown><ScalarInterpolator" + fields +
                                      "/></Unknown><Switch whichChoice='1'><Group/><ScalarInterpolator USE='I'/>"
                                      "</Switch><Group><ScalarInterpolator USE='I'/></Group>" +
                                      route("T.fraction_changed", "I.set_fraction"));
  const SceneGraph& graph = imported.scene.graph;
  const std::size_t sensor = nodeNamed(graph, "T"), interpolator = nodeNamed(graph, "I");
  ASSERT_LT(interpolator, graph.nodes.size());
  EXPECT_EQ(std::ranges::count(graph.nodes, "I", &Node::name), 1);
  EXPECT_EQ(std::get<Interpolator>(graph.nodes[interpolator].content),
            (Interpolator{InterpolatorKind::scalar, {0, 1}, {2, 3}}));
  EXPECT_EQ(graph.routes, (std::vector<Route>{{sensor, "fraction_changed", interpolator, "set_fraction"}}));
}

TEST(Interpolators, ThatContainThemselvesAreReadOnceWithOneWarning) {
  const Imported imported = readScene("<Unknown><ScalarInterpolator DEF='I'><ScalarInterpolator USE='I'/>"
                                      "</ScalarInterpolator></Unknown><Group><ScalarInterpolator USE='I'/></Group>");
  EXPECT_EQ(std::ranges::count(imported.scene.graph.nodes, "I", &Node::name), 1);
  EXPECT_EQ(std::ranges::count_if(imported.warnings,
                                  [](const std::string& warning) {
                                    return warning.find("names a node that contains it") != std::string::npos;
                                  }),
            1)
      << ::testing::PrintToString(imported.warnings);
}

TEST(Interpolators, ThatAreMalformedAreLeftOutWithTheirRoutesAndOneWarning) {
  for (const auto& [fields, fault] :
       std::map<std::string, std::string>{{"key='0 1 0.5' keyValue='0 1 2'", "its keys are not in ascending order"},
                                          {"keyValue='0 1 2'", "it has values but no keys"},
                                          {"key='0 1' keyValue='0'", "it has 1 numbers in keyValue for 2 keys"},
                                          {"key='0 NaN' keyValue='0 1'", "key holds something that is no number"}}) {
    const std::string scene = "<TimeSensor DEF='T'/><ScalarInterpolator DEF='I' " + fields + "/><Group>" +
                              "<ScalarInterpolator USE='I'/></Group>" + route("T.fraction_changed", "I.set_fraction");
    const Imported imported = readScene(scene);
    ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
    EXPECT_NE(imported.warnings[0].find("ScalarInterpolator: " + fault), std::string::npos) << imported.warnings[0];
    EXPECT_TRUE(imported.scene.graph.routes.empty());
    ImportOptions strict;
    strict.strict = true;
    EXPECT_EQ(imgeo::testing::errorOf("<X3D><Scene>" + scene + "</Scene></X3D>", "a.x3d", strict).kind(),
              ErrorKind::malformed);
  }
}

} // namespace
} // namespace imgeo::x3d
