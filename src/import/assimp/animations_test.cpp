#include "base/file.h"
#include "base/testing.h"
#include "import/assimp/testing.h"
#include "import/import.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

TEST(Assimp, ReadsAnimationsOfNodes) {
  const TemporaryDirectory directory;
  const std::string animation = R"(<library_animations><animation>
    <source id="at"><float_array id="ata" count="3">0 1 4</float_array><technique_common>
      <accessor source="#ata" count="3" stride="1"><param name="TIME" type="float"/></accessor></technique_common></source>
    <source id="av"><float_array id="ava" count="9">2 0 0 2 1 0 5 1 0</float_array><technique_common>
      <accessor source="#ava" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <sampler id="as"><input semantic="INPUT" source="#at"/><input semantic="OUTPUT" source="#av"/></sampler>
    <channel source="#as" target="b/move"/></animation></library_animations>
  <library_visual_scenes>)";
  writeFile(directory / "a.dae", asBytes(replaced(collada, {{"<translate>2 0 0", "<translate sid=\"move\">2 0 0"},
                                                            {"<library_visual_scenes>", animation}})));
  const SceneGraph graph = importFile(directory / "a.dae").scene.graph;
  const auto right = std::ranges::find(graph.nodes, "b", &Node::name); // Assimp names animated scenes by ids
  ASSERT_NE(right, graph.nodes.end());
  EXPECT_TRUE(std::holds_alternative<Transform>(right->content));
  ASSERT_EQ(graph.routes.size(), 2u) << "what does not move has no interpolator";
  const auto& sensor = std::get<TimeSensor>(graph.nodes.at(graph.routes[0].fromNode).content);
  EXPECT_TRUE(sensor.enabled && sensor.loop);
  EXPECT_EQ(sensor.cycleInterval, 4);
  EXPECT_EQ(std::get<Interpolator>(graph.nodes.at(graph.routes[1].fromNode).content),
            (Interpolator{InterpolatorKind::position, {0, 0.25, 1}, {2, 0, 0, 2, 1, 0, 5, 1, 0}}));
  EXPECT_EQ(graph.routes[1].toNode, static_cast<std::size_t>(right - graph.nodes.begin()));
  EXPECT_EQ(graph.routes[1].toField, "translation");
}

TEST(Assimp, ReadsAnimationsOfMorphTargets) {
  const TemporaryDirectory directory;
  const std::string fbx = R"(; FBX 7.4.0 project file
FBXHeaderExtension:  {
FBXHeaderVersion: 1003
FBXVersion: 7400
}
GlobalSettings:  {
Version: 1000
}
Objects:  {
Geometry: 1, "Geometry::corner", "Mesh" {
Vertices: *9 {
a: 0,0,0,1,0,0,0,1,0
}
PolygonVertexIndex: *3 {
a: 0,1,-3
}
}
Geometry: 2, "Geometry::raised", "Shape" {
Version: 100
Indexes: *1 {
a: 1
}
Vertices: *3 {
a: 0,0,1
}
Normals: *3 {
a: 0,0,0
}
}
Model: 3, "Model::flag", "Mesh" {
Version: 232
}
Deformer: 4, "Deformer::shapes", "BlendShape" {
Version: 100
}
Deformer: 5, "SubDeformer::raised", "BlendShapeChannel" {
Version: 100
DeformPercent: 0
FullWeights: *1 {
a: 100
}
}
AnimationStack: 6, "AnimStack::wave", "" {
Properties70:  {
P: "LocalStop", "KTime", "Time", "",92372316000
}
}
AnimationLayer: 7, "AnimLayer::base", "" {
}
AnimationCurveNode: 8, "AnimCurveNode::DeformPercent", "" {
Properties70:  {
P: "d|DeformPercent", "Number", "", "A",0
}
}
AnimationCurve: 9, "AnimCurve::", "" {
Default: 0
KeyVer: 4008
KeyTime: *3 {
a: 0,46186158000,92372316000
}
KeyValueFloat: *3 {
a: 0,100,50
}
KeyAttrFlags: *1 {
a: 24836
}
KeyAttrDataFloat: *4 {
a: 0,0,0,0
}
KeyAttrRefCount: *1 {
a: 3
}
}
}
Connections:  {
C: "OO",3,0
C: "OO",1,3
C: "OO",4,1
C: "OO",5,4
C: "OO",2,5
C: "OO",7,6
C: "OO",8,7
C: "OP",8,5, "DeformPercent"
C: "OP",9,8, "d|DeformPercent"
}
)";
  writeFile(directory / "a.fbx", asBytes(fbx));
  const Imported imported = importFile(directory / "a.fbx");
  const SceneGraph& graph = imported.scene.graph;
  const auto raised = std::ranges::find(graph.nodes, "raised", &Node::name);
  ASSERT_NE(raised, graph.nodes.end());
  EXPECT_EQ(std::get<Displacer>(raised->content).weight, 0);
  ASSERT_EQ(graph.routes.size(), 2u);
  EXPECT_EQ(std::get<TimeSensor>(graph.nodes.at(graph.routes[0].fromNode).content).cycleInterval, 2);
  EXPECT_EQ(std::get<Interpolator>(graph.nodes.at(graph.routes[1].fromNode).content),
            (Interpolator{InterpolatorKind::scalar, {0, 0.5, 1}, {0, 1, 0.5}}));
  EXPECT_EQ(graph.routes[1].toNode, static_cast<std::size_t>(raised - graph.nodes.begin()));
  EXPECT_EQ(graph.routes[1].toField, "weight");
  EXPECT_TRUE(std::ranges::any_of(imported.warnings, [](const std::string& warning) {
    return warning == "The weights at rest of 1 morph target are 0: Assimp does not report those of FBX files.";
  })) << ::testing::PrintToString(imported.warnings);

  // A channel of targets that no mesh has is left out with one warning.
  writeFile(directory / "b.fbx", asBytes(replaced(fbx, {{"C: \"OO\",2,5\n", ""}})));
  EXPECT_TRUE(importFile(directory / "b.fbx").scene.graph.routes.empty());
}

} // namespace
} // namespace imgeo::testing
