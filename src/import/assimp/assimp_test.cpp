#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

/// A Collada document with two instances of a textured square, a camera and a light.
const std::string collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit name="meter" meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_cameras><camera id="cam" name="door"><optics><technique_common><perspective><xfov>60</xfov>
    <aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar></perspective></technique_common></optics></camera>
  </library_cameras>
  <library_lights><light id="lamp" name="lamp"><technique_common><point><color>1 0.5 0</color></point>
    </technique_common></light></library_lights>
  <library_images><image id="img" name="img"><init_from>wood.png</init_from></image></library_images>
  <library_effects><effect id="fx"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>img</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="common"><phong><emission><color>0 0 0.5 1</color></emission>
    <diffuse><texture texture="t" texcoord="UV"/></diffuse></phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="oak" name="oak"><instance_effect url="#fx"/></material></library_materials>
  <library_geometries><geometry id="square" name="square"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array><technique_common>
      <accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
      <accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
      </technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist material="m" count="1"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#u" offset="0" set="0"/><vcount>4</vcount><p>0 1 2 3</p></polylist>
    </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="scene" name="hall">
    <node id="a" name="left"><translate>-2 0 0</translate><instance_geometry url="#square"><bind_material>
      <technique_common><instance_material symbol="m" target="#oak"><bind_vertex_input semantic="UV"
      input_semantic="TEXCOORD" input_set="0"/></instance_material></technique_common></bind_material></instance_geometry></node>
    <node id="b" name="right"><translate>2 0 0</translate><instance_geometry url="#square"><bind_material>
      <technique_common><instance_material symbol="m" target="#oak"/></technique_common></bind_material></instance_geometry></node>
    <node id="c" name="eye"><translate>0 0 9</translate><instance_camera url="#cam"/></node>
    <node id="d" name="light"><instance_light url="#lamp"/></node>
  </visual_scene></library_visual_scenes>
  <scene><instance_visual_scene url="#scene"/></scene>
</COLLADA>)";

/// `text` with each of `from` replaced.
std::string replaced(std::string text, const std::vector<std::pair<std::string, std::string>>& changes) {
  for (const auto& [from, to] : changes)
    text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(Assimp, ReadsTheSetsOfTextureCoordinatesThatTexturesUse) {
  const std::string two =
      replaced(collada, {{"<emission><color>0 0 0.5 1</color></emission>",
                          "<emission><texture texture=\"t\" texcoord=\"UV1\"/></emission>"},
                         {"<vertices id=\"v\">",
                          "<source id=\"w\"><float_array id=\"wa\" count=\"8\">0 0 .5 0 .5 .5 0 .5</float_array>"
                          "<technique_common><accessor source=\"#wa\" count=\"4\" stride=\"2\"><param name=\"S\" "
                          "type=\"float\"/><param name=\"T\" type=\"float\"/></accessor></technique_common></source>"
                          "<vertices id=\"v\">"},
                         {"<vcount>", "<input semantic=\"TEXCOORD\" source=\"#w\" offset=\"0\" set=\"1\"/><vcount>"},
                         {"input_set=\"0\"/>",
                          "input_set=\"0\"/><bind_vertex_input semantic=\"UV1\" input_semantic=\"TEXCOORD\" "
                          "input_set=\"1\"/>"}});
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(two));
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const Imported imported = importFile(directory / "a.dae");
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(mesh.texCoordMappings, (std::vector<std::string>{"", "TEXCOORD_1"}));
  EXPECT_TRUE(std::ranges::any_of(mesh.texCoords, [](Vec2f t) { return t.x == 1; }));
  EXPECT_EQ(mesh.texCoords1.size(), mesh.texCoords.size());
  EXPECT_TRUE(std::ranges::all_of(mesh.texCoords1, [](Vec2f t) { return t.x <= .5f && t.y <= .5f; }));
  std::map<TextureRole, std::string> mappings;
  for (const TextureUse& use : imported.scene.graph.appearances.at(0).textures)
    mappings[use.role] = use.mapping;
  EXPECT_EQ(mappings,
            (std::map<TextureRole, std::string>{{TextureRole::color, ""}, {TextureRole::emissive, "TEXCOORD_1"}}));
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{}));

  writeFile(directory / "b.dae",
            asBytes(replaced(two, {{"<emission><texture texture=\"t\" texcoord=\"UV1\"/></emission>", ""}})));
  const Imported unused = importFile(directory / "b.dae");
  EXPECT_TRUE(unused.scene.meshes.at(0).texCoordMappings.empty());
  EXPECT_EQ(unused.warnings, (std::vector<std::string>{
                                 "1 mesh has texture coordinates that no texture uses, which are not carried over."}));
  ImportOptions all;
  all.attributes.all = true;
  EXPECT_EQ(importFile(directory / "b.dae", all).scene.meshes.at(0).texCoordMappings.size(), 2u);
}

TEST(Assimp, DrawsNoBonesForAScenesNodesWithoutMeshes) {
  // Assimp reads no morph controllers: what the node instantiates is lost.
  const std::string text = replaced(
      collada,
      {{"<library_visual_scenes>",
        R"(<library_controllers><controller id="m"><morph source="#square">
    <source id="t"><IDREF_array id="ta" count="1">square</IDREF_array><technique_common><accessor source="#ta" count="1"
      stride="1"><param name="IDREF" type="IDREF"/></accessor></technique_common></source>
    <source id="k"><float_array id="ka" count="1">0</float_array><technique_common><accessor source="#ka" count="1"
      stride="1"><param name="MORPH_WEIGHT" type="float"/></accessor></technique_common></source>
    <targets><input semantic="MORPH_TARGET" source="#t"/><input semantic="MORPH_WEIGHT" source="#k"/></targets></morph>
    </controller></library_controllers><library_visual_scenes>)"},
       {"<instance_geometry url=\"#square\"><bind_material>", "<instance_controller url=\"#m\"><bind_material>"},
       {"</instance_geometry>", "</instance_controller>"},
       {"<instance_geometry url=\"#square\"><bind_material>", "<instance_controller url=\"#m\"><bind_material>"},
       {"</instance_geometry>", "</instance_controller>"}});
  const Error error = errorOf(text, "a.dae");
  EXPECT_EQ(error.kind(), ErrorKind::malformed);
  EXPECT_EQ(error.message(), "the file has no triangles, lines or points");
}

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

TEST(Assimp, ReadsNodesMaterialsTexturesCamerasAndLights) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(collada));
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const Imported imported = importFile(directory / "a.dae");
  EXPECT_EQ(imported.format, "DAE");
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].elementCount(), 2u);
  EXPECT_EQ(scene.meshes[0].texCoords.size(), 4u);
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  ASSERT_EQ(instances.size(), 2u);
  EXPECT_EQ(instances[0].worldFromShape.point({}), (Vec3d{-2, 0, 0}));
  EXPECT_EQ(instances[1].worldFromShape.point({}), (Vec3d{2, 0, 0}));
  const Appearance& oak = appearanceOf(scene.graph, 0);
  EXPECT_EQ(oak.name, "oak");
  EXPECT_EQ(std::get<Material>(oak.material).emissiveColor, (Vec3f{0, 0, 0.5f}));
  ASSERT_EQ(oak.textures.size(), 1u);
  EXPECT_EQ(scene.graph.images.at(0).url, "wood.png");
  ASSERT_TRUE(firstOf<Viewpoint>(scene.graph));
  EXPECT_NEAR(firstOf<Viewpoint>(scene.graph)->fieldOfView, 2 * std::atan(std::tan(3.14159265 / 6) / 1.5), 1e-3);
  ASSERT_TRUE(firstOf<PointLight>(scene.graph));
  EXPECT_EQ(firstOf<PointLight>(scene.graph)->color, (Vec3f{1, 0.5f, 0}));
}

TEST(Assimp, LeavesMissingTexturesOut) {
  const TemporaryDirectory directory;
  writeFile(directory / "a.dae", asBytes(collada));
  const Imported imported = importFile(directory / "a.dae");
  EXPECT_TRUE(appearanceOf(imported.scene.graph, 0).textures.empty());
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("wood.png"), std::string::npos);
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(importFile(directory / "a.dae", strict), Error);
}

TEST(Assimp, KeepsTheSharpEdgesOfMeshesWithoutNormals) {
  const std::string cube = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
  const Imported imported = importBytes(asBytes(cube), "cube.off");
  const Mesh& mesh = imported.scene.meshes.at(0);
  ASSERT_EQ(mesh.corners.size(), 36u);
  for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
    const std::size_t first = i / 3 * 3;
    const Vec3d a(mesh.cornerPosition(first)), b(mesh.cornerPosition(first + 1)), c(mesh.cornerPosition(first + 2));
    EXPECT_LT(length(Vec3d(mesh.normals.at(mesh.corners[i])) - cross(b - a, c - a)), 1e-6);
  }
}

TEST(Assimp, MultipliesEmissionByTheTextureInAc3dFiles) {
  const TemporaryDirectory directory;
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto rolesOf = [&](const std::string& emissive, const std::string& texture) {
    writeFile(directory / "a.ac", asBytes("AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 0 0 0 emis " + emissive +
                                          " spec 0 0 0 shi 10 trans 0\nOBJECT world\nkids 1\nOBJECT poly\n" + texture +
                                          "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x0\nmat 0\nrefs 3\n"
                                          "0 0 0\n1 1 0\n2 0 1\nkids 0\n"));
    std::vector<TextureRole> roles;
    const Imported imported = importFile(directory / "a.ac");
    for (const TextureUse& use : appearanceOf(imported.scene.graph, 0).textures)
      roles.push_back(use.role);
    return roles;
  };
  using enum TextureRole;
  EXPECT_EQ(rolesOf("0.3 0.3 0.3", "texture \"wood.png\"\n"), (std::vector{color, emissive}));
  EXPECT_EQ(rolesOf("0 0 0", "texture \"wood.png\"\n"), (std::vector{color}));
  EXPECT_EQ(rolesOf("0.3 0.3 0.3", ""), (std::vector<TextureRole>{}));
}

TEST(Assimp, MergesEqualMaterials) {
  const auto glass = [](const std::string& color) {
    return "MATERIAL \"glass\" rgb " + color + " amb 0 0 0 emis 0 0 0 spec 0.5 0.5 0.5 shi 10 trans 0\n";
  };
  std::string panes = "AC3Db\n" + glass("0 0 1") + glass("0 0 1") + glass("1 0 0") +
                      "OBJECT world\nkids 1\nOBJECT poly\nname \"panes\"\nnumvert 3\n"
                      "0 0 0\n1 0 0\n0 1 0\nnumsurf 3\n";
  for (const std::string material : {"0", "1", "2"})
    panes += "SURF 0x0\nmat " + material + "\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n";
  const SceneGraph graph = importBytes(asBytes(panes + "kids 0\n"), "panes.ac").scene.graph;
  EXPECT_EQ(shapeNodes(graph).size(), 3u);
  EXPECT_EQ(graph.appearances.size(), 2u);
}

TEST(Assimp, ReadsTheTransparencyOfColladaInTheWayOfItsWriter) {
  const auto read = [](const std::string& transparency, const std::string& opaque) {
    std::string text = collada;
    const std::string before = "</phong>";
    text.insert(text.find(before), "<transparent opaque=\"" + opaque +
                                       "\"><color>1 1 1 1</color></transparent><transparency><float>" + transparency +
                                       "</float></transparency>");
    return importBytes(asBytes(text), "a.dae");
  };
  const auto transparencyOf = [](const Imported& imported) {
    return std::get<Material>(appearanceOf(imported.scene.graph, 0).material).transparency;
  };
  const auto isWarned = [](const Imported& imported) {
    return std::ranges::any_of(imported.warnings,
                               [](const std::string& w) { return w.find("COLLADA's rule") != w.npos; });
  };
  EXPECT_EQ(transparencyOf(read("1", "A_ONE")), 0);
  EXPECT_EQ(transparencyOf(read("0.75", "A_ONE")), 0.25f);
  EXPECT_EQ(transparencyOf(read("0.75", "RGB_ZERO")), 0.75f);
  EXPECT_FALSE(isWarned(read("0.75", "A_ONE")));
  // By the rule the whole model would be invisible.
  EXPECT_EQ(transparencyOf(read("0", "A_ONE")), 0);
  EXPECT_TRUE(isWarned(read("0", "A_ONE")));
}

TEST(Assimp, SaysWhatItsLibraryHasRepaired) {
  const std::string off = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n3 0 1 2\n";
  const Imported imported = importBytes(asBytes(off), "a.off");
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_EQ(imported.warnings[0], "Assimp, which reads the format, reports: OFF: Vertex index is out of range.");
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(importBytes(asBytes(off), "a.off", strict), Error);
}

TEST(Assimp, RefusesUnreadableFiles) {
  const Error error = errorOf(collada.substr(0, 900), "a.dae");
  EXPECT_EQ(error.kind(), ErrorKind::malformed);
  EXPECT_EQ(error.location(), "a.dae");
  EXPECT_EQ(errorOf("nothing", "a.fbx").kind(), ErrorKind::malformed);
  EXPECT_EQ(errorOf("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n", "a.off").message().substr(0, 63),
            "is damaged or no OFF file; Assimp, which reads the format, says");
}

} // namespace
} // namespace imgeo::testing
