// Reads documents with nodes that become other nodes.

#include "import/testing.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

Imported readScene(const std::string& scene, const std::string& version = "4.0") {
  return importBytes(asBytes("<X3D version='" + version + "'><Scene>" + scene + "</Scene></X3D>"), "a.x3d");
}

/// The name of a node's element, for these tests.
std::string elementOf(const Node& node) {
  if (const GenericNode* generic = std::get_if<GenericNode>(&node.content))
    return generic->element;
  return std::holds_alternative<Transform>(node.content) ? "Transform"
         : std::holds_alternative<Group>(node.content)   ? "Group"
                                                         : "Shape";
}

/// The elements below a node: "Transform(Group(Shape(Box)))".
std::string treeOf(const SceneGraph& graph, std::size_t index) {
  const Node& node = graph.nodes[index];
  std::vector<std::string> children;
  for (const std::size_t child : node.children)
    children.push_back(treeOf(graph, child));
  return elementOf(node) + (children.empty() ? "" : fmt::format("({})", fmt::join(children, ",")));
}

/// The first node whose element has this name.
const Node& firstOf(const SceneGraph& graph, const std::string& element) {
  return *std::ranges::find_if(graph.nodes, [&](const Node& node) { return elementOf(node) == element; });
}

std::string field(const Node& node, const std::string& name) {
  const auto found = std::ranges::find(node.fields, name, &FieldText::name);
  return found == node.fields.end() ? "none" : found->value;
}

TEST(NodeConversions, MakeGroupsAndTransformsOfNodesOfCad) {
  const Imported imported = readScene("<CADLayer><CADAssembly DEF='A'><CADPart DEF='P' translation='1 2 "
                                      "3'><CADFace><Shape containerField='shape'><Box/>"
                                      "</Shape></CADFace></CADPart></CADAssembly></CADLayer><CADAssembly USE='A'/>");
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)), "Group(Group(Transform(Group(Shape(Box)))))");
  EXPECT_EQ(graph.roots.at(1), graph.nodes[graph.roots[0]].children.at(0));
  const Node& part = firstOf(graph, "Transform");
  EXPECT_EQ(part.name, "P");
  EXPECT_EQ(std::get<Transform>(part.content).translation, (Vec3d{1, 2, 3}));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"Written as other nodes: CADAssembly as Group (2), CADFace as "
                                                        "Group (1), CADLayer as Group (1), CADPart as Transform (1)."});
}

TEST(NodeConversions, MakeImageTexturesOfX3domsTextures) {
  const std::string pixel =
      "data:image/png;base64,"
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";
  const Imported imported =
      readScene("<Shape><Appearance><Texture DEF='T' url='" + pixel +
                "'/></Appearance><Box/></Shape><Shape><Appearance>"
                "<Material><Texture containerField='diffuseTexture'><img src='" +
                pixel +
                "'/></Texture></Material></Appearance><Box/></Shape><Shape><Appearance><Texture "
                "USE='T'/></Appearance><Box/></Shape><Shape><Appearance><Texture><canvas/></Texture></Appearance><Box/>"
                "</Shape>");
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)), "Shape(Appearance(ImageTexture),Box)");
  EXPECT_EQ(treeOf(graph, graph.roots.at(1)), "Shape(Appearance(Material(ImageTexture)),Box)");
  EXPECT_EQ(graph.images.size(), 1u); // the same file
  ASSERT_EQ(imported.warnings.size(), 2u) << ::testing::PrintToString(imported.warnings);
  EXPECT_TRUE(imported.warnings[0].starts_with("canvas (1) left out")) << imported.warnings[0];
  EXPECT_EQ(imported.warnings[1], "Written as other nodes: Texture as ImageTexture (4).");
}

TEST(NodeConversions, HideTheLayersOfCadThatAreNotVisible) {
  const std::string layer = "<CADLayer visible='true, false'><CADFace/><CADFace DEF='F'/><CADFace/></CADLayer>";
  const SceneGraph old = readScene(layer, "3.3").scene.graph;
  EXPECT_EQ(treeOf(old, old.roots.at(0)), "Group(Group,Group(Group),Group)");
  EXPECT_EQ(field(old.nodes[old.nodes[old.roots[0]].children[1]], "visible"), "false");
  EXPECT_EQ(field(old.nodes[old.roots[0]], "visible"), "none");
  const SceneGraph now = readScene("<CADLayer visible='false'><CADFace/></CADLayer>").scene.graph;
  EXPECT_EQ(field(now.nodes[now.roots.at(0)], "visible"), "false");
}

TEST(NodeConversions, DrawAHumanoidOnceInItsPose) {
  const SceneGraph graph =
      readScene(
          "<HAnimHumanoid translation='0 1 0'><Coordinate DEF='C' containerField='skinCoord' point='0 0 0 1 0 0 1 1 "
          "0'/><HAnimJoint DEF='J' containerField='skeleton' rotation='0 0 1 1'><HAnimSegment DEF='S'><Coordinate "
          "point='0 0 0'/><Shape><Box/></Shape></HAnimSegment></HAnimJoint><HAnimJoint USE='J' "
          "containerField='joints'/><HAnimSegment USE='S' containerField='segments'/><Shape "
          "containerField='skin'><TriangleSet><Coordinate USE='C'/></TriangleSet></Shape></HAnimHumanoid>")
          .scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)), "Transform(Transform(Group(Shape(Box))),Shape)");
}

TEST(NodeConversions, KeepTheTransformOfASiteAndNameWhatHasNoEffectInAHumanoid) {
  const Imported imported = readScene(
      "<HAnimHumanoid><HAnimMotion containerField='motions'/><HAnimJoint DEF='J' containerField='skeleton'>"
      "<HAnimDisplacer containerField='displacers' weight='1'/><HAnimSegment><HAnimDisplacer "
      "containerField='displacers' weight='1'/><HAnimSite DEF='S' translation='0 3 0' rotation='0 0 1 0.5' scale='2 1 "
      "1' center='0 1 0'><Shape><Box/></Shape></HAnimSite></HAnimSegment></HAnimJoint></HAnimHumanoid>");
  const SceneGraph& graph = imported.scene.graph;
  const auto site = std::ranges::find(graph.nodes, "S", &Node::name);
  ASSERT_NE(site, graph.nodes.end());
  const Transform& transform = std::get<Transform>(site->content);
  EXPECT_EQ(transform.translation, (Vec3d{0, 3, 0}));
  EXPECT_EQ(transform.rotation.angle, 0.5);
  EXPECT_EQ(transform.scale, (Vec3d{2, 1, 1}));
  EXPECT_EQ(transform.center, (Vec3d{0, 1, 0}));
  EXPECT_EQ(imported.warnings.at(0),
            "Without effect, since pages do not play it: HAnimDisplacer (2), HAnimMotion (1).");
}

TEST(NodeConversions, MakeAMaterialOfACommonSurfaceShader) {
  const Imported imported = readScene(
      "<Shape><Appearance><Material diffuseColor='0 1 0'/><CommonSurfaceShader DEF='S' diffuseFactor='0.5 0.5 0.5' "
      "specularFactor='1 1 1' alphaFactor='0.25' shininessFactor='0.5' normalScale='2 2 2'><PixelTexture "
      "containerField='diffuseTexture' image='1 1 1 0'/><PixelTexture containerField='displacementTexture' image='1 1 "
      "1 "
      "0'/><SurfaceShaderTexture containerField='normalTexture'><PixelTexture containerField='texture' image='1 1 3 "
      "0'/><TextureTransform scale='2 2'/></SurfaceShaderTexture></CommonSurfaceShader></Appearance><Box/></Shape>"
      "<Shape><Appearance><CommonSurfaceShader USE='S'/></Appearance><Box/></Shape>");
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)),
            "Shape(Appearance(Material(PixelTexture,PixelTexture),TextureTransform),Box)");
  const Node& material = firstOf(graph, "Material");
  EXPECT_EQ(field(material, "diffuseColor"), "0.5 0.5 0.5");
  EXPECT_EQ(field(material, "specularColor"), "1 1 1");
  EXPECT_EQ(field(material, "transparency"), "0.75");
  EXPECT_EQ(field(material, "shininess"), "0.5");
  EXPECT_EQ(field(material, "ambientIntensity"), "0.4");
  EXPECT_EQ(field(material, "normalScale"), "none") << "X3D's field of this name is another";
  EXPECT_EQ(field(graph.nodes[material.children.at(0)], "containerField"), "diffuseTexture");
  EXPECT_EQ(field(graph.nodes[material.children.at(1)], "containerField"), "normalTexture");
  EXPECT_EQ(field(material, "normalTextureMapping"), field(firstOf(graph, "TextureTransform"), "mapping"));
  EXPECT_EQ(treeOf(graph, graph.roots.at(1)), "Shape(Appearance(Material(PixelTexture,PixelTexture)),Box)");
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{
                                   "Written as other nodes: CommonSurfaceShader as Material (2), SurfaceShaderTexture "
                                   "as its texture (1).",
                                   "Left out of materials: the displacementTexture of CommonSurfaceShader (1)."}));
}

TEST(NodeConversions, MakeAPhysicalMaterialOfASurfaceShaderThatReflects) {
  const Imported imported = readScene(
      "<Shape><Appearance><CommonSurfaceShader DEF='S' diffuseFactor='0 0.5 1' reflectionFactor='0.5 0.5 0.5' "
      "environmentFactor='1 1 0' fresnelBlend='0.5' relativeIndexOfRefraction='1.5' shininessFactor='1' "
      "transmissionFactor='0.2 0.2 0.2' normalSpace='OBJECT' diffuseTextureCoordinatesId='0'>"
      "<PixelTexture containerField='diffuseTexture' image='1 1 1 0'/><ImageTexture containerField='specularTexture'/>"
      "<ComposedCubeMapTexture containerField='environmentTexture'/></CommonSurfaceShader></Appearance><Box/></Shape>"
      "<Shape><Appearance><CommonSurfaceShader USE='S'/></Appearance><Box/></Shape>");
  const SceneGraph& graph = imported.scene.graph;
  const std::string tree = "PhysicalMaterial(PixelTexture,IORMaterialExtension,SpecularMaterialExtension,"
                           "TransmissionMaterialExtension)";
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)), "Shape(Appearance(" + tree + "),Box)");
  EXPECT_EQ(treeOf(graph, graph.roots.at(1)), "Shape(Appearance(" + tree + "),Box)");
  const Node& material = firstOf(graph, "PhysicalMaterial");
  EXPECT_EQ(field(material, "baseColor"), "0 0.214 1") << "linear";
  EXPECT_EQ(field(material, "metallic"), "0");
  EXPECT_EQ(field(material, "roughness"), "0.3522") << "(2 / 130) ^ 1/4";
  EXPECT_EQ(field(graph.nodes[material.children.at(0)], "containerField"), "baseTexture");
  EXPECT_EQ(field(firstOf(graph, "SpecularMaterialExtension"), "specularColor"), "0.26 0.26 0")
      << "0.5 (0.5 + 0.5 0.04)";
  EXPECT_EQ(field(firstOf(graph, "TransmissionMaterialExtension"), "transmission"), "0.2");
  EXPECT_EQ(imported.warnings,
            (std::vector<std::string>{"Written as other nodes: CommonSurfaceShader as PhysicalMaterial (2).",
                                      "Left out of materials: the environmentTexture of CommonSurfaceShader (1), the "
                                      "normalSpace of CommonSurfaceShader (1), the specularTexture of "
                                      "CommonSurfaceShader (1)."}));
}

TEST(NodeConversions, DrawTheLayersOfALayerSetWithTheCameraOfTheActiveOne) {
  const Imported imported =
      readScene("<Viewpoint/><LayerSet order='0 2' activeLayer='0'><Layer><Viewport/><Shape><Box/></Shape></Layer>"
                "<Layer><Transform><Viewpoint/></Transform><Background/><Shape><Sphere/></Shape></Layer></LayerSet>");
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(1)), "Group(Group(Viewport,Shape(Box)),Group(Transform,Shape(Sphere)))");
  const Node& set = graph.nodes[graph.roots.at(1)];
  EXPECT_EQ(set.fields, (std::vector<FieldText>{}));
  EXPECT_EQ(field(graph.nodes[set.children.at(0)], "visible"), "false");
  EXPECT_EQ(field(graph.nodes[set.children.at(1)], "visible"), "none");
  EXPECT_EQ(
      imported.warnings,
      (std::vector<std::string>{
          "Without effect, since layers fill the page's one view: Viewport (1).",
          "Written as other nodes: Layer as Group (2), LayerSet as Group (1).",
          "Hidden, since the order of their LayerSet does not name them: Layer (1).",
          "Left out of layers that are not active, since pages have one camera: Background (1), Viewpoint (1)."}));
}

TEST(NodeConversions, ReadThePhysicalMaterialOfX3dom) {
  const SceneGraph graph =
      readScene("<Shape><Appearance><PhysicalMaterial baseColorFactor='1 0.5 0 0.75' metallicFactor='1' "
                "emissiveFactor='0 0 1' alphaMode='BLEND'><PixelTexture containerField='baseColorTexture' image='1 1 1 "
                "0'/></PhysicalMaterial></Appearance><Box/></Shape><Shape><Appearance><PhysicalMaterial "
                "baseColor='0 0 1'/></Appearance></Shape>")
          .scene.graph;
  const Node& material = firstOf(graph, "PhysicalMaterial");
  EXPECT_EQ(field(material, "baseColor"), "1 0.5 0");
  EXPECT_EQ(field(material, "transparency"), "0.25");
  EXPECT_EQ(field(material, "metallic"), "1");
  EXPECT_EQ(field(material, "roughness"), "0.2");
  EXPECT_EQ(field(material, "emissiveColor"), "0 0 1");
  EXPECT_EQ(field(firstOf(graph, "Appearance"), "alphaMode"), "BLEND");
  EXPECT_EQ(field(firstOf(graph, "PixelTexture"), "containerField"), "baseTexture");
}

TEST(NodeConversions, PassOverShadersInFavourOfTheMaterialBesideThem) {
  const Imported imported = importBytes(
      asBytes(
          "#X3D V4.0 utf8\nShape { appearance Appearance { material TwoSidedMaterial { diffuseColor 1 0 0 "
          "backDiffuseColor 0 1 0 } shaders [ ComposedShader { language \"GLSL\" inputOutput SFFloat k 1\n parts [ "
          "ShaderPart { type \"VERTEX\" url \"data:,void main() {}\" } ] } PackagedShader { } ] } geometry Box { } }"),
      "a.x3dv");
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(treeOf(graph, graph.roots.at(0)), "Shape(Appearance(Material),Box)");
  EXPECT_EQ(firstOf(graph, "Material").fields, (std::vector<FieldText>{{"diffuseColor", "1 0 0"}}));
  ASSERT_EQ(imported.warnings.size(), 3u);
  EXPECT_TRUE(imported.warnings[0].starts_with("ComposedShader (1) left out, since pages run no shaders of others"));
  EXPECT_TRUE(imported.warnings[1].starts_with("PackagedShader (1) left out"));
}

} // namespace
} // namespace imgeo::testing
