#include "base/file.h"
#include "base/testing.h"
#include "import/testing.h"
#include "scene/fog_depths.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

Imported readScene(const std::string& scene, const ImportOptions& options = {}) {
  return importBytes(asBytes("<X3D version='4.0'><Scene>" + scene + "</Scene></X3D>"), "a.x3d", options);
}

Mesh meshOf(const std::string& geometry) {
  const Imported imported = readScene("<Shape>" + geometry + "</Shape>");
  EXPECT_EQ(imported.scene.meshes.size(), 1u) << geometry;
  return imported.scene.meshes.at(0);
}

/// Corner positions, element by element.
std::vector<Vec3f> cornersOf(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  for (std::size_t i = 0; i < mesh.corners.size(); ++i)
    corners.push_back(mesh.cornerPosition(i));
  return corners;
}

const std::string square = "<Coordinate point='0 0 0, 1 0 0, 1 1 0, 0 1 0'/>";
const Vec3f a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};

TEST(X3d, ReadsEveryKindOfSurface) {
  const std::vector<Vec3f> two{a, b, c, a, c, d};
  EXPECT_EQ(cornersOf(meshOf("<IndexedFaceSet coordIndex='0 1 2 3 -1'>" + square + "</IndexedFaceSet>")), two);
  EXPECT_EQ(cornersOf(meshOf("<IndexedTriangleSet index='0 1 2 0 2 3'>" + square + "</IndexedTriangleSet>")), two);
  EXPECT_EQ(cornersOf(meshOf("<IndexedTriangleFanSet index='0 1 2 3'>" + square + "</IndexedTriangleFanSet>")), two);
  EXPECT_EQ(cornersOf(meshOf("<TriangleFanSet fanCount='4'>" + square + "</TriangleFanSet>")), two);
  EXPECT_EQ(cornersOf(meshOf("<IndexedTriangleStripSet index='0 1 3 2 -1'>" + square + "</IndexedTriangleStripSet>")),
            (std::vector<Vec3f>{a, b, d, b, c, d}));
  EXPECT_EQ(cornersOf(meshOf("<TriangleStripSet stripCount='3'>" + square + "</TriangleStripSet>")),
            (std::vector<Vec3f>{a, b, c}));
  EXPECT_EQ(cornersOf(meshOf("<TriangleSet>" + square + "</TriangleSet>")), (std::vector<Vec3f>{a, b, c}));
  EXPECT_EQ(cornersOf(meshOf("<ElevationGrid xDimension='2' zDimension='2' zSpacing='2' height='1 2 3 4'/>")),
            (std::vector<Vec3f>{{0, 1, 0}, {0, 3, 2}, {1, 4, 2}, {0, 1, 0}, {1, 4, 2}, {1, 2, 0}}));
}

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    volume += dot(Vec3d(mesh.cornerPosition(i)),
                  cross(Vec3d(mesh.cornerPosition(i + 1)), Vec3d(mesh.cornerPosition(i + 2)))) /
              6;
  return volume;
}

TEST(X3d, ReadsExtrusions) {
  EXPECT_NEAR(volumeOf(meshOf("<Extrusion/>")), 4, 1e-6);
  EXPECT_NEAR(volumeOf(meshOf("<Extrusion spine='0 1 0 0 -1 0'/>")), 8, 1e-6);
  EXPECT_NEAR(volumeOf(meshOf("<Extrusion spine='0 -1 0 0 1 0' scale='1 0.5' orientation='0 1 0 1.5707963'/>")), 4,
              1e-5);
  EXPECT_NEAR(volumeOf(meshOf("<Extrusion convex='false' crossSection='0 0 0 3 1 3 1 1 3 1 3 0 0 0'/>")), 5, 1e-6);
  std::string spine;
  for (int i = 0; i <= 32; ++i)
    spine += std::to_string(3 * std::cos(i % 32 * 0.19634954)) + " 0 " +
             std::to_string(-3 * std::sin(i % 32 * 0.19634954)) + " ";
  const Mesh ring = meshOf("<Extrusion beginCap='false' endCap='false' spine='" + spine +
                           "' crossSection='0.5 0 0 -0.5 -0.5 0 0 0.5 0.5 0'/>");
  EXPECT_EQ(ring.elementCount(), 32u * 4 * 2);
  EXPECT_NEAR(std::abs(volumeOf(ring)), 2 * 3.14159265 * 3 * 0.5, 0.3);
  EXPECT_EQ(readScene("<Shape><Extrusion spine='0 0 0'/></Shape>").scene.meshes.size(), 0u);
}

TEST(X3d, ReadsLinesAndPoints) {
  const Mesh lines = meshOf("<IndexedLineSet coordIndex='0 1 2 -1 3 0'>" + square + "</IndexedLineSet>");
  EXPECT_EQ(lines.topology, Topology::lines);
  EXPECT_EQ(cornersOf(lines), (std::vector<Vec3f>{a, b, b, c, d, a}));
  EXPECT_EQ(cornersOf(meshOf("<LineSet vertexCount='2 2'>" + square + "</LineSet>")), (std::vector<Vec3f>{a, b, c, d}));
  const Mesh points =
      meshOf("<PointSet>" + square + "<ColorRGBA color='1 0 0 1 0 1 0 0.5 0 0 1 1 1 1 1 1'/></PointSet>");
  EXPECT_EQ(points.topology, Topology::points);
  EXPECT_EQ(asRgba8(points.colors.at(1)), (Rgba8{0, 255, 0, 128}));
  EXPECT_EQ(points.colorComponents, 4u);
}

TEST(X3d, ReadsDepthsInFogAsAnAttributeIfItIsKept) {
  const std::string scene = "<Shape><IndexedFaceSet coordIndex='3 0 1 -1 1 2 3'>" + square +
                            "<FogCoordinate depth='0.25 0.5'/></IndexedFaceSet></Shape>";
  ImportOptions options;
  EXPECT_TRUE(readScene(scene, options).scene.meshes.at(0).namedAttributes.empty());
  options.attributes.names = {fogDepthName};
  const Mesh mesh = readScene(scene, options).scene.meshes.at(0);
  ASSERT_EQ(mesh.namedAttributes.size(), 1u);
  const auto& [name, components, values] = mesh.namedAttributes[0];
  EXPECT_EQ(name, fogDepthName);
  EXPECT_EQ(components, 1u);
  ASSERT_EQ(values.size(), mesh.wedgeCount());
  for (std::size_t wedge = 0; wedge < values.size(); ++wedge)
    EXPECT_EQ(values[wedge], mesh.positions[mesh.wedgePositions[wedge]] == a ? 0.25f : 0.5f);
}

TEST(X3d, ReversesClockwiseFaces) {
  EXPECT_EQ(cornersOf(meshOf("<IndexedFaceSet ccw='false' coordIndex='0 1 2'>" + square + "</IndexedFaceSet>")),
            (std::vector<Vec3f>{c, b, a}));
}

TEST(X3d, ReadsAttributesPerVertexAndPerFace) {
  const std::string two = "coordIndex='0 1 2 -1 0 2 3 -1' creaseAngle='3.2'";
  const std::string colors = "<Color color='1 0 0 0 0 1'/>";
  const Mesh byFace =
      meshOf("<IndexedFaceSet " + two + " colorPerVertex='false'>" + square + colors + "</IndexedFaceSet>");
  EXPECT_EQ(byFace.colors.at(byFace.corners[0]), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(byFace.colors.at(byFace.corners[3]), (Rgba8{0, 0, 255, 255}));
  EXPECT_EQ(byFace.positions.size(), 4u);
  const Mesh byIndex =
      meshOf("<IndexedFaceSet " + two + " colorIndex='1 1 1 -1 0 0 0'>" + square + colors + "</IndexedFaceSet>");
  EXPECT_EQ(byIndex.colors.at(byIndex.corners[0]), (Rgba8{0, 0, 255, 255}));
  EXPECT_TRUE(byIndex.normals.empty()); // smooth everywhere: computed later
}

TEST(X3d, ReadsTheSetsOfTextureCoordinatesThatTexturesName) {
  const std::string sets = "<MultiTextureCoordinate><TextureCoordinate mapping='base' point='0 0, 1 0, 1 1, 0 1'/>"
                           "<TextureCoordinate mapping='unused' point='9 9, 9 9, 9 9, 9 9'/>"
                           "<TextureCoordinate mapping='light' point='0 0, 2 0, 2 2, 0 2'/></MultiTextureCoordinate>";
  const std::string surface = "<IndexedFaceSet coordIndex='0 1 2 3 -1'>" + square + sets + "</IndexedFaceSet>";
  const std::string appearance = "<Appearance><Material emissiveTextureMapping='light'/></Appearance>";
  const Mesh mesh = meshOf(appearance + surface);
  ASSERT_EQ(texCoordSetCount(mesh), 2u);
  EXPECT_EQ(mesh.texCoordMappings, (std::vector<std::string>{"base", "light"}));
  EXPECT_EQ(mesh.texCoords[2], (Vec2f{1, 1}));
  EXPECT_EQ(mesh.texCoords1[2], (Vec2f{2, 2}));
  EXPECT_EQ(texCoordSetCount(meshOf(surface)), 1u);
  EXPECT_TRUE(readScene("<Shape>" + appearance + "<IndexedFaceSet coordIndex='0 1 2 3 -1'>" + square +
                        "<MultiTextureCoordinate><TextureCoordinate point='0 0, 1 0, 1 1, 0 1'/><TextureCoordinate "
                        "mapping='light' point='0 0'/></MultiTextureCoordinate></IndexedFaceSet></Shape>")
                  .scene.meshes.empty());
}

TEST(X3d, HasSharpEdgesBeyondTheCreaseAngle) {
  const std::string roof = "<Coordinate point='0 0 0 1 0 0 1 0 1 0 0 1 1 -1 0 1 -1 1'/></IndexedFaceSet>";
  const std::string faces = "coordIndex='0 3 2 1 -1 1 2 5 4'";
  const Mesh creased = meshOf("<IndexedFaceSet creaseAngle='0.5' " + faces + ">" + roof);
  EXPECT_EQ(creased.positions.size(), 6u);
  EXPECT_EQ(creased.wedgeCount(), 8u);
  EXPECT_EQ(creased.normals.at(creased.corners[0]), (Vec3f{0, 1, 0}));
  const Mesh smooth = meshOf("<IndexedFaceSet creaseAngle='2' " + faces + ">" + roof);
  EXPECT_EQ(smooth.wedgeCount(), 6u);
}

TEST(X3d, SharesGeometryAndFindsCoordinatesByUse) {
  const Imported imported =
      readScene("<Shape DEF='S'><IndexedFaceSet DEF='G' coordIndex='0 1 2'><Coordinate DEF='C' point='0 0 0 "
                "1 0 0 1 1 0'/>"
                "</IndexedFaceSet></Shape><Transform translation='1 2 3'><Shape USE='S'/></Transform>"
                "<Shape><IndexedFaceSet USE='G'/></Shape>"
                "<Shape><TriangleSet><Coordinate USE='C'/></TriangleSet></Shape>");
  EXPECT_EQ(imported.scene.meshes.size(), 2u);
  const std::vector<ShapeInstance> instances = shapeInstances(imported.scene.graph);
  ASSERT_EQ(instances.size(), 4u);
  EXPECT_EQ(instances[1].node, instances[0].node);
  EXPECT_EQ(instances[1].worldFromShape.translation, (Vec3d{1, 2, 3}));
  EXPECT_EQ(shapeOf(imported.scene.graph, instances[2].node).mesh, 0u);
}

TEST(X3d, KeepsAllOtherNodesAsTheyAre) {
  const Imported imported =
      readScene("<Viewpoint DEF='V' description='a &amp; b' fieldOfView='1'/><Switch whichChoice='1' id='s'><Group/>"
                "<Shape class='x'><Appearance><Material diffuseColor='1 0 0'/></Appearance><TriangleSet>" +
                square + "</TriangleSet></Shape></Switch><Shape><Box size='1 2 3'/></Shape>");
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.roots.size(), 3u);
  const Node& viewpoint = graph.nodes[graph.roots[0]];
  EXPECT_EQ(viewpoint.name, "V");
  EXPECT_EQ(viewpoint.fields, (std::vector<FieldText>{{"description", "a & b"}, {"fieldOfView", "1"}}));
  const Node& choice = graph.nodes[graph.roots[1]];
  EXPECT_EQ(std::get<GenericNode>(choice.content).element, "Switch");
  const Node& shape = graph.nodes[choice.children.at(1)];
  EXPECT_TRUE(std::holds_alternative<Shape>(shape.content));
  EXPECT_EQ(shape.fields, (std::vector<FieldText>{{"class", "x"}}));
  EXPECT_EQ(std::get<GenericNode>(graph.nodes[shape.children.at(0)].content).element, "Appearance");
  EXPECT_EQ(std::get<GenericNode>(graph.nodes[graph.roots[2]].content).element, "Shape");
}

TEST(X3d, KeepsShortGeometryInTheDocument) {
  const std::string shape = "<Shape><TriangleSet>" + square + "</TriangleSet></Shape>";
  ImportOptions options;
  options.inlineBytes = 200;
  const Imported small = readScene(shape, options);
  EXPECT_TRUE(small.scene.meshes.empty());
  EXPECT_EQ(std::get<GenericNode>(small.scene.graph.nodes[small.scene.graph.roots.at(0)].content).element, "Shape");
  for (const char* drawn : {"<Extrusion/>", "<ElevationGrid xDimension='2' zDimension='2' height='0 0 0 1'/>"})
    EXPECT_TRUE(readScene("<Shape>" + std::string(drawn) + "</Shape>", options).scene.meshes.empty()) << drawn;
  options.inlineBytes = 20;
  EXPECT_EQ(readScene(shape, options).scene.meshes.size(), 1u);
}

TEST(X3d, KeepsOnlyShorterGeometryWhereThereIsMuchOfIt) {
  const std::string triangle = "<Shape><TriangleSet>" + square + "</TriangleSet></Shape>";
  std::string longer = triangle;
  longer.insert(longer.find("point='") + 7, std::string(300, ' '));
  ImportOptions options;
  options.inlineBytes = 1000;
  const auto meshesOf = [&](int count) {
    std::string shapes;
    for (int i = 0; i < count; ++i)
      shapes += triangle + longer;
    return readScene(shapes, options).scene.meshes.size();
  };
  EXPECT_EQ(meshesOf(50), 0u);
  EXPECT_EQ(meshesOf(500), 500u);
}

/// The rational quarter of a circle, as control points multiplied by their weights, and these.
const std::string quarterCircle = "point='1 0 0 0.70710678 0.70710678 0 0 1 0'/>",
                  quarterWeights = "weight='1 0.70710678 1'";

TEST(X3d, TurnsNurbsCurvesIntoLines) {
  const Mesh line = meshOf("<NurbsCurve " + quarterWeights + "><Coordinate " + quarterCircle + "</NurbsCurve>");
  EXPECT_EQ(line.topology, Topology::lines);
  EXPECT_GT(line.elementCount(), 5u);
  for (const Vec3f& position : line.positions)
    EXPECT_NEAR(length(Vec3d(position)), 1, 1e-6);
  EXPECT_EQ(meshOf("<NurbsCurve order='2'><CoordinateDouble point='0 0 0 1 0 0 1 1 0'/></NurbsCurve>").elementCount(),
            2u);
  // Without its last control point, which `closed` asks for, the curve stays open.
  const std::string diamond = "<NurbsCurve closed='true' order='4'><Coordinate point='1 0 0 0 1 0 -1 0 0 0 -1 0";
  const Mesh open = meshOf(diamond + "'/></NurbsCurve>"), loop = meshOf(diamond + " 1 0 0'/></NurbsCurve>");
  EXPECT_EQ(open.cornerPosition(0), (Vec3f{1, 0, 0}));
  const Vec3f begin = loop.cornerPosition(0), end = loop.cornerPosition(loop.corners.size() - 1);
  EXPECT_NEAR(length(Vec3d(begin) - Vec3d(end)), 0, 1e-6);
  EXPECT_NE(begin, (Vec3f{1, 0, 0}));
}

TEST(X3d, TurnsNurbsSurfacesIntoTriangles) {
  const std::string patch =
      "uDimension='3' vDimension='2' vOrder='2' weight='1 0.70710678 1 1 0.70710678 1'>"
      "<Coordinate point='1 0 0 0.70710678 0.70710678 0 0 1 0 1 0 2 0.70710678 0.70710678 1.41421356 0 1 2'/>";
  const Imported imported = readScene("<Shape><NurbsPatchSurface " + patch + "</NurbsPatchSurface></Shape>");
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("1 NURBS geometry became triangles"), std::string::npos) << imported.warnings[0];
  const Mesh& quarter = imported.scene.meshes.at(0);
  for (std::size_t i = 0; i < quarter.wedgeCount(); ++i) {
    const Vec3f position = quarter.positions[quarter.wedgePositions[i]], normal = quarter.normals[i];
    EXPECT_NEAR(std::hypot(position.x, position.y), 1, 1e-6);
    EXPECT_NEAR(normal.x * position.x + normal.y * position.y, 1, 1e-6); // u x v points outwards here
    EXPECT_NEAR(quarter.texCoords[i].y, position.z / 2, 1e-6);
  }
  const std::string contour = "<Contour2D><ContourPolyline2D controlPoint='0 0 1 0 1 0.5 0 0.5 0 0'/></Contour2D>";
  const Mesh half = meshOf("<NurbsTrimmedSurface " + patch + contour + "</NurbsTrimmedSurface>");
  for (const Vec3f& position : half.positions)
    EXPECT_LE(position.z, 1 + 1e-6);
}

TEST(X3d, SweepsNurbsCurves) {
  const std::string contour = "<ContourPolyline2D containerField='FIELD' controlPoint='1 1 1 -1 -1 -1 -1 1 1 1'/>";
  const auto withField = [&](const std::string& name) {
    return std::string(contour).replace(contour.find("FIELD"), 5, name);
  };
  // A quarter of a tube of radius 10: 5 pi long, with a cross-section whose circumference is 8.
  const Mesh swept =
      meshOf("<NurbsSweptSurface solid='false'>" + withField("crossSectionCurve") + "<NurbsCurve " + quarterWeights +
             "><Coordinate point='10 0 0 7.0710678 7.0710678 0 0 10 0'/></NurbsCurve>"
             "</NurbsSweptSurface>");
  const Mesh swung =
      meshOf("<NurbsSwungSurface>" + withField("profileCurve") + "<NurbsCurve2D containerField='trajectoryCurve' " +
             quarterWeights + " controlPoint='10 0 7.0710678 7.0710678 0 10'/></NurbsSwungSurface>");
  for (const Mesh* mesh : {&swept, &swung}) {
    double area = 0;
    for (std::size_t i = 0; i < mesh->corners.size(); i += 3) {
      const Vec3d at(mesh->cornerPosition(i));
      area += length(cross(Vec3d(mesh->cornerPosition(i + 1)) - at, Vec3d(mesh->cornerPosition(i + 2)) - at)) / 2;
    }
    EXPECT_NEAR(area, 8 * 5 * 3.14159265, 0.3);
    EXPECT_EQ(mesh->normals.size(), mesh->wedgeCount());
  }
}

TEST(X3d, RefusesInvalidNurbs) {
  for (const std::string node :
       {"<NurbsCurve/>", "<NurbsCurve order='1'><Coordinate point='0 0 0 1 0 0'/></NurbsCurve>",
        "<NurbsCurve order='33'><Coordinate point='0 0 0 1 0 0'/></NurbsCurve>",
        "<NurbsCurve order='2.5'><Coordinate point='0 0 0 1 0 0 2 0 0'/></NurbsCurve>",
        "<NurbsCurve><Coordinate point='0 0 0 1 0 0'/></NurbsCurve>",
        "<NurbsCurve weight='1 0 1'><Coordinate point='0 0 0 1 0 0 1 1 0'/></NurbsCurve>",
        "<NurbsCurve weight='1 1e-300 1'><Coordinate point='1e30 0 0 1e30 0 0 1e30 1 0'/></NurbsCurve>",
        "<NurbsPatchSurface uDimension='3' vDimension='3'><Coordinate point='0 0 0'/></NurbsPatchSurface>",
        "<NurbsSweptSurface/>", "<NurbsSwungSurface><NurbsCurve2D/></NurbsSwungSurface>"}) {
    const Imported imported = readScene("<Shape>" + node + "</Shape>");
    EXPECT_EQ(imported.scene.meshes.size(), 0u) << node;
    EXPECT_GE(imported.warnings.size(), 1u) << node;
  }
}

TEST(X3d, WarnsOfTextureCoordinatesThatItLeavesOutOrApproximates) {
  const std::string quad = "<Shape><IndexedFaceSet coordIndex='0 1 2 3'>" + square;
  EXPECT_TRUE(readScene(quad + "<TextureCoordinateGenerator mode='COORD'/></IndexedFaceSet></Shape>").warnings.empty());
  for (const std::size_t inlineBytes : {0, 1000}) {
    ImportOptions options;
    options.inlineBytes = inlineBytes;
    EXPECT_EQ(readScene(quad + "<TextureCoordinateGenerator/></IndexedFaceSet></Shape>", options).warnings.size(), 1u);
    EXPECT_EQ(readScene(quad + "<MultiTextureCoordinate><TextureCoordinate point='0 0 1 0 1 1 0 1'/>"
                               "<TextureCoordinate point='0 0 1 0 1 1 0 1'/></MultiTextureCoordinate>"
                               "</IndexedFaceSet></Shape>",
                        options)
                  .warnings.size(),
              1u);
  }
}

TEST(X3d, KeepsNodesWithoutEffectAndSaysSoInOneLineForEachReason) {
  const Imported imported = readScene("<KeySensor/><AudioClip/><ColorDamper/><Shape><Sphere/></Shape><KeySensor/>");
  EXPECT_EQ(imported.warnings,
            (std::vector<std::string>{"Without effect, since pages do not play it: ColorDamper (1), KeySensor (2).",
                                      "Without effect, since pages play no sound: AudioClip (1)."}));
  EXPECT_TRUE(readScene("<Shape><Text string='" + std::string(5000, 'a') + "'/></Shape>").warnings.empty());
}

TEST(X3d, LeavesOutNodesThatPagesCannotDrawAndUnknownOnesWithTheirChildren) {
  const std::string scene = "<VolumeData DEF='V'><ImageTexture3D/></VolumeData>\n<Script DEF='S'/><Foo><Shape DEF='B'>"
                            "<Box/></Shape></Foo>\n<Foo/><Transform><VolumeData USE='V'/><Shape USE='B'/></Transform>"
                            "<ROUTE fromNode='S' fromField='a' toNode='V' toField='b'/>";
  const Imported imported = readScene(scene);
  EXPECT_EQ(imported.warnings,
            (std::vector<std::string>{
                "Foo (2) left out, since it is no node of X3D 4.0; the first is at a.x3d:2:19.",
                "Script (1) left out, since pages run no scripts; it is at a.x3d:2:2.",
                "VolumeData (1) left out, since pages render no volumes and no three-dimensional textures; it is at "
                "a.x3d:1:28."}));
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.roots.size(), 1u);
  const Node& transform = graph.nodes[graph.roots[0]];
  ASSERT_EQ(transform.children.size(), 1u) << "the Shape that an unknown node contains can be used";
  EXPECT_EQ(std::get<GenericNode>(graph.nodes[transform.children[0]].content).element, "Shape");
  ImportOptions strict;
  strict.strict = true;
  const Error error = testing::errorOf("<X3D><Scene>" + scene + "</Scene></X3D>", "a.x3d", strict);
  EXPECT_EQ(error.kind(), ErrorKind::unsupported);
  EXPECT_EQ(error.location(), "a.x3d:1:14");
}

TEST(X3d, DrawsNoTargetOfASensorASecondTime) {
  const SceneGraph graph = readScene("<Shape DEF='S'><Box/></Shape><TransformSensor><Shape USE='S'/>"
                                     "<MetadataString name='m'/></TransformSensor>")
                               .scene.graph;
  ASSERT_EQ(graph.roots.size(), 2u);
  ASSERT_EQ(graph.nodes[graph.roots[1]].children.size(), 1u);
}

TEST(X3d, ReadsTexturesFromItsOwnFolderOnly) {
  const testing::TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "in");
  writeFile(directory / "in/wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  writeFile(directory / "out.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto read = [&](const std::string& url) {
    const std::string scene = "<X3D><Scene><Shape><Appearance><ImageTexture url='" + url +
                              "'/></Appearance><TriangleSet>" + square + "</TriangleSet></Shape></Scene></X3D>";
    writeFile(directory / "in/a.x3d", asBytes(scene));
    return importFile(directory / "in/a.x3d");
  };
  EXPECT_EQ(read("\"lost.png\" \"wood.png\"").scene.graph.images.size(), 1u);
  const Imported outside = read("../out.png");
  EXPECT_TRUE(outside.scene.graph.images.empty());
  ASSERT_EQ(outside.warnings.size(), 1u);
  EXPECT_NE(outside.warnings[0].find("outside"), std::string::npos) << outside.warnings[0];
  EXPECT_TRUE(read("http://example.org/a.png").scene.graph.images.empty());
}

TEST(X3d, GoesOnToTheNextUrlOfADamagedTextureThatAnotherNodeHasAlone) {
  const testing::TemporaryDirectory directory;
  writeFile(directory / "damaged.png", asBytes("\x89PNG\r\n\x1a\n..."));
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto shape = [](const std::string& urls) {
    return "<Shape><Appearance><ImageTexture url='" + urls + "'/></Appearance><TriangleSet>" + square +
           "</TriangleSet></Shape>";
  };
  writeFile(directory / "a.x3d", asBytes("<X3D><Scene>" + shape("\"damaged.png\"") +
                                         shape("\"damaged.png\" \"wood.png\"") + "</Scene></X3D>"));
  const std::vector<ImageFile>& images = importFile(directory / "a.x3d").scene.graph.images;
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1].url, "wood.png");
}

TEST(X3d, ReadsThePicturesOfABackground) {
  const testing::TemporaryDirectory directory;
  for (const char* name : {"front.png", "top.png"})
    writeFile(directory / name, asBytes("\x89PNG\r\n\x1a\n..."));
  writeFile(directory / "a.x3d", asBytes("<X3D><Scene><Background frontUrl='\"lost.png\" \"front.png\"' "
                                         "topUrl='top.png' backUrl='http://a.org/back.png'/></Scene></X3D>"));
  const Imported imported = importFile(directory / "a.x3d");
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.images.size(), 2u);
  const auto& background = std::get<GenericNode>(graph.nodes[graph.roots[0]].content);
  EXPECT_EQ(background.images, (std::vector<FieldImage>{{"frontUrl", 0}, {"topUrl", 1}}));
  EXPECT_EQ(graph.images[1].url, "top.png");
  EXPECT_EQ(imported.warnings, (std::vector<std::string>{"1 texture is left on other hosts."}));
}

TEST(X3d, KeepsRemoteUrlsOfATextureThatIsNotLocal) {
  const testing::TemporaryDirectory directory;
  writeFile(directory / "wood.png", asBytes("\x89PNG\r\n\x1a\n..."));
  const auto read = [&](const std::string& urls) {
    writeFile(directory / "a.x3d", asBytes("<X3D><Scene><Shape><Appearance><ImageTexture url='" + urls +
                                           "'/></Appearance><Box/></Shape></Scene></X3D>"));
    return importFile(directory / "a.x3d");
  };
  const Imported here = read("\"http://a.org/wood.png\" \"lost.png\" \"wood.png\"");
  EXPECT_EQ(here.scene.graph.images.size(), 1u);
  EXPECT_TRUE(here.warnings.empty());
  const Imported there = read("\"lost.png\" \"http://a.org/wood.png\" \"https://b.org/\" \"lost.gif\"");
  EXPECT_EQ(there.warnings, (std::vector<std::string>{"1 texture is left on other hosts."}));
  const auto texture = std::ranges::find_if(there.scene.graph.nodes, [](const Node& node) {
    const GenericNode* other = std::get_if<GenericNode>(&node.content);
    return other && other->element == "ImageTexture";
  });
  ASSERT_NE(texture, there.scene.graph.nodes.end());
  EXPECT_EQ(texture->fields, (std::vector<FieldText>{{"url", "\"http://a.org/wood.png\" \"https://b.org/\""}}));
}

TEST(X3d, KeepsDamagedNodesUnlessStrict) {
  const std::string damaged = "<Shape><TriangleSet>" + square +
                              "</TriangleSet></Shape>"
                              "<Shape><IndexedFaceSet coordIndex='0 1 9'>" +
                              square +
                              "</IndexedFaceSet></Shape>"
                              "<Group USE='nothing'/>";
  const Imported imported = readScene(damaged);
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
  ASSERT_EQ(imported.warnings.size(), 2u);
  EXPECT_NE(imported.warnings[0].find("position 9 of 4"), std::string::npos) << imported.warnings[0];
  EXPECT_NE(imported.warnings[1].find("nothing"), std::string::npos);
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(readScene(damaged, strict), Error);
}

TEST(X3d, IgnoresMalformedFieldsAndKeepsExtremeOnes) {
  const Imported imported = readScene("<Transform scale='NaN 1 1' translation='1 2 3'/><Transform translation='1 2'/>"
                                      "<Transform scale='1e30 1e30 1e30'/><Transform scale='0 0 0'/>");
  const SceneGraph& graph = imported.scene.graph;
  const auto transformAt = [&](std::size_t root) {
    return std::get<Transform>(graph.nodes[graph.roots.at(root)].content);
  };
  EXPECT_EQ(transformAt(0).scale, (Vec3d{1, 1, 1}));
  EXPECT_EQ(transformAt(0).translation, (Vec3d{1, 2, 3}));
  EXPECT_EQ(graph.nodes[graph.roots[0]].fields, (std::vector<FieldText>{{"translation", "1 2 3"}}));
  EXPECT_EQ(transformAt(2).scale, (Vec3d{1e30, 1e30, 1e30}));
  EXPECT_EQ(transformAt(3).scale, (Vec3d{}));
  ASSERT_EQ(imported.warnings.size(), 4u);
  EXPECT_TRUE(imported.warnings[2].starts_with("1 Transform scales by 0")) << imported.warnings[2];
  EXPECT_TRUE(imported.warnings[3].starts_with("1 Transform scales by more than")) << imported.warnings[3];
  EXPECT_NE(imported.warnings[0].find("a.x3d:1:"), std::string::npos) << imported.warnings[0];
  EXPECT_NE(imported.warnings[0].find("Transform: scale holds something that is no number"), std::string::npos);
}

TEST(X3d, ExpandsPrototypesOfXml) {
  const Imported imported =
      readScene("<ProtoDeclare name='P'><ProtoInterface><field name='c' type='SFColor' accessType='inputOutput' "
                "value='1 1 1'/>"
                "</ProtoInterface><ProtoBody><Material><IS><connect nodeField='diffuseColor' "
                "protoField='c'/></IS></Material>"
                "</ProtoBody></ProtoDeclare><Shape><Appearance><ProtoInstance name='P' containerField='material'>"
                "<fieldValue name='c' value='0 1 0'/></ProtoInstance></Appearance></Shape>");
  const SceneGraph& graph = imported.scene.graph;
  const Node& appearance = graph.nodes[graph.nodes[graph.roots.at(0)].children.at(0)];
  const Node& material = graph.nodes[appearance.children.at(0)];
  EXPECT_EQ(std::get<GenericNode>(material.content).element, "Material");
  EXPECT_EQ(material.fields, (std::vector<FieldText>{{"diffuseColor", "0 1 0"}, {"containerField", "material"}}));
}

TEST(X3d, KeepsCommentsAndTheHead) {
  const SceneGraph graph =
      importBytes(asBytes("<!--of somebody--><X3D profile='Immersive' version='3.1'><head><!--in the head--></head>"
                          "<Scene><Group><!--within--></Group></Scene></X3D>"),
                  "a.x3d")
          .scene.graph;
  EXPECT_EQ(graph.head.fields, (std::vector<FieldText>{{"profile", "Immersive"}, {"version", "3.1"}}));
  const auto commentOf = [&](std::size_t node) {
    const GenericNode& other = std::get<GenericNode>(graph.nodes[node].content);
    return other.element == commentElement ? other.text : "no comment";
  };
  EXPECT_EQ(commentOf(graph.roots.at(0)), "of somebody");
  EXPECT_EQ(commentOf(graph.head.header.at(0)), "in the head");
  EXPECT_EQ(commentOf(graph.nodes[graph.roots.at(1)].children.at(0)), "within");
}

TEST(X3d, WarnsOfSizesThatAreNoneOrRefusesThemIfStrict) {
  const auto warningsOf = [](const std::string& geometry) {
    return readScene("<Shape>" + geometry + "</Shape>").warnings;
  };
  EXPECT_EQ(warningsOf("<Box size='1 0 3'/>").size(), 0u) << "flat boxes are common";
  EXPECT_EQ(warningsOf("<Sphere radius='-1'/>"),
            std::vector<std::string>{"A geometry is left as it is: a.x3d:1:35: Sphere: radius '-1' is not a size."});
  for (const char* geometry : {"<Box size='1 x 1'/>", "<Box size='1 1'/>", "<Box size='1 -1 1'/>",
                               "<Sphere radius=''/>", "<Cone height='nan'/>", "<Rectangle2D size='1 inf'/>"}) {
    EXPECT_EQ(warningsOf(geometry).size(), 1u) << geometry;
    ImportOptions strict;
    strict.strict = true;
    EXPECT_THROW(
        importBytes(asBytes(std::string("<X3D><Scene><Shape>") + geometry + "</Shape></Scene></X3D>"), "a.x3d", strict),
        Error)
        << geometry;
  }
}

TEST(X3d, RefusesEntitiesAndCycles) {
  const auto kindOf = [](const std::string& text) {
    try {
      importBytes(asBytes(text), "a.x3d");
    } catch (const Error& error) {
      return error.kind();
    }
    return ErrorKind::usage;
  };
  std::string chain = "<X3D><Scene><Group DEF='g0'/>";
  for (int i = 1; i < 1000; ++i)
    chain += fmt::format("<Group DEF='g{}'><Group USE='g{}'/></Group>", i, i - 1);
  EXPECT_EQ(kindOf(chain + "</Scene></X3D>"), ErrorKind::limit);
  EXPECT_EQ(kindOf("<!DOCTYPE X3D [<!ENTITY a 'aaaa'>]><X3D><Scene/></X3D>"), ErrorKind::unsupported);
  EXPECT_EQ(kindOf("<X3D><Scene><Shape></Scene></X3D>"), ErrorKind::malformed);
  std::string deep = "<X3D><Scene>";
  for (int i = 0; i < 100000; ++i)
    deep += "<Group>";
  for (int i = 0; i < 100000; ++i)
    deep += "</Group>";
  EXPECT_EQ(kindOf(deep + "</Scene></X3D>"), ErrorKind::limit);
  const Imported circle =
      readScene("<Group DEF='A'><Group DEF='B'><Group USE='A'/></Group></Group><Shape><TriangleSet>" + square +
                "</TriangleSet></Shape>");
  EXPECT_EQ(circle.warnings.size(), 1u);
}

TEST(X3d, FindsTexturesThroughFewUses) {
  const auto hasTexCoords = [](int uses) {
    std::string chain = "<Material DEF='m0'><PixelTexture image='1 1 1 255'/></Material>";
    for (int i = 1; i <= uses; ++i)
      chain += fmt::format("<Material DEF='m{}'><Material USE='m{}'/></Material>", i, i - 1);
    const Imported imported = readScene(
        fmt::format("{}<Shape><Appearance><Material USE='m{}'/></Appearance><TriangleSet>{}</TriangleSet></Shape>",
                    chain, uses, square));
    return !imported.scene.meshes.at(0).texCoords.empty();
  };
  EXPECT_TRUE(hasTexCoords(0));
  EXPECT_FALSE(hasTexCoords(5));
  EXPECT_THROW(hasTexCoords(100000), Error);
}

TEST(X3d, SharesEqualAppearancesOfLargeScenes) {
  const auto sceneOf = [](std::size_t shapes) {
    std::string scene = "<X3D><Scene><Shape DEF='Appearance'><Appearance DEF='Mine'><Material/></Appearance></Shape>";
    for (std::size_t i = 1; i < shapes; ++i)
      scene += i % 2 == 0 ? "<Shape><Appearance><Material/></Appearance><Box/></Shape>"
                          : "<Shape><Appearance><Material shininess='1'/></Appearance><Box/></Shape>";
    return importBytes(asBytes(scene + "</Scene></X3D>"), "a.x3d");
  };
  const auto countOf = [](const Imported& imported, std::string_view element) {
    return std::ranges::count_if(imported.scene.graph.nodes, [&](const Node& node) {
      const GenericNode* generic = std::get_if<GenericNode>(&node.content);
      return generic && generic->element == element;
    });
  };
  EXPECT_EQ(countOf(sceneOf(10'000), "Appearance"), 10'000) << "small scenes keep what their authors wrote";
  const Imported large = sceneOf(10'001);
  EXPECT_EQ(countOf(large, "Appearance"), 3) << "the one with a DEF stays its own";
  EXPECT_EQ(countOf(large, "Material"), 3);
  EXPECT_EQ(large.warnings.at(0), "9998 Appearances are USEs of an equal one: the scene has more than 10000 shapes.");
}

} // namespace
} // namespace imgeo
