#include "export/export.h"

#include "import/import.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <assimp/Importer.hpp>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace imgeo {
namespace {

using testing::randomMesh;
using testing::sceneOf;
using testing::shapeName;

/// The values at a corner, which do not depend on how corners share wedges and positions.
struct Corner {
  Vec3f position, normal;
  Vec2f texCoord;
  Rgba8 color{255, 255, 255, 255}; ///< readers give white to meshes without colours if other meshes have colours
};

std::vector<Corner> cornersOf(const Mesh& mesh) {
  std::vector<Corner> corners;
  for (const std::uint32_t wedge : mesh.corners) {
    Corner corner;
    corner.position = mesh.positions[mesh.wedgePositions[wedge]];
    if (!mesh.normals.empty())
      corner.normal = mesh.normals[wedge];
    if (!mesh.texCoords.empty())
      corner.texCoord = mesh.texCoords[wedge];
    if (!mesh.colors.empty())
      corner.color = asRgba8(mesh.colors[wedge]);
    corners.push_back(corner);
  }
  return corners;
}

std::vector<Corner> cornersOf(const Scene& scene) {
  std::vector<Corner> corners;
  for (const ShapeInstance& instance : shapeInstances(scene.graph))
    for (const Corner& corner : cornersOf(scene.meshes[shapeOf(scene.graph, instance.node).mesh]))
      corners.push_back(corner);
  return corners;
}

/// Expects exactly equal values except for normals, whose length readers may set to 1 again.
void expectEqual(const std::vector<Corner>& read, const std::vector<Corner>& written) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].position, written[i].position);
    EXPECT_EQ(read[i].texCoord, written[i].texCoord);
    EXPECT_EQ(read[i].color, written[i].color);
    EXPECT_LE(length(read[i].normal - written[i].normal), 1e-6f);
  }
}

/// Gives the first shape of a scene an appearance.
void setAppearance(Scene& scene, const AnyMaterial& material) {
  std::get<Shape>(scene.graph.nodes.at(0).content).appearance = scene.graph.appearances.size();
  scene.graph.appearances.push_back({"", material, {}, AlphaMode::automatic, 0.5f});
}

void makeLines(Mesh& mesh) {
  mesh.topology = Topology::lines;
  mesh.corners.resize(mesh.corners.size() / 2 * 2);
}

TEST(Export, ChoosesTheFormatByTheFileName) {
  EXPECT_EQ(meshFormatOf("a/b.ply"), MeshFormat::ply);
  EXPECT_EQ(meshFormatOf("b.obj.GLB"), MeshFormat::glb);
  EXPECT_EQ(meshFormatOf("b.Obj"), MeshFormat::obj);
  EXPECT_EQ(meshFormatOf("ply"), std::nullopt);
  EXPECT_EQ(meshFormatOf("b.stl"), std::nullopt);
}

TEST(Export, WritesTheSameBytesEveryTime) {
  for (const MeshFormat format : {MeshFormat::ply, MeshFormat::obj, MeshFormat::glb})
    EXPECT_EQ(exportScene(sceneOf({randomMesh(3), randomMesh(4)}), format),
              exportScene(sceneOf({randomMesh(3), randomMesh(4)}), format));
}

TEST(ExportedPly, IsReadBackByOurImport) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Mesh mesh = randomMesh(seed);
    const Imported read = importBytes(exportScene(sceneOf({mesh}), MeshFormat::ply), "a.ply");
    ASSERT_EQ(read.scene.meshes.size(), 1u);
    EXPECT_EQ(read.scene.meshes[0].topology, mesh.topology);
    EXPECT_EQ(read.scene.meshes[0].normals.empty(), mesh.normals.empty());
    EXPECT_EQ(read.scene.meshes[0].texCoords.empty(), mesh.texCoords.empty());
    EXPECT_EQ(read.scene.meshes[0].colors.empty(), mesh.colors.empty());
    if (mesh.topology == Topology::points) {
      // In PLY, each vertex is a point, whether the mesh uses its wedge or not.
      mesh.corners.clear();
      for (std::uint32_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
        mesh.corners.push_back(wedge);
    }
    expectEqual(cornersOf(read.scene), cornersOf(mesh));
  }
}

TEST(ExportedPly, HoldsAllShapesAndAttributesThatOnlySomeHave) {
  Mesh plain = testing::grid(3), colored = testing::sphere(4, 5);
  colored.colors.assign(colored.wedgeCount(), Rgba8{1, 2, 3, 255});
  Scene scene = sceneOf({plain, colored});
  setAppearance(scene, Material{.diffuseColor{1, 0, 0.2f}});
  const Imported read = importBytes(writePly(scene), "a.ply");
  ASSERT_EQ(read.scene.meshes.size(), 1u);
  const std::vector<Corner> corners = cornersOf(read.scene);
  ASSERT_EQ(corners.size(), plain.corners.size() + colored.corners.size());
  EXPECT_EQ(corners.front().color, (Rgba8{255, 0, 51, 255}));
  EXPECT_EQ(corners.back().color, (Rgba8{1, 2, 3, 255}));
  EXPECT_EQ(corners.back().position, cornersOf(colored).back().position);
}

TEST(ExportedPly, HasFurtherAttributes) {
  Mesh plain = testing::grid(2), attributed = testing::sphere(4, 5);
  testing::Random random(1);
  const auto count = static_cast<std::uint32_t>(attributed.wedgeCount());
  for (const char* name : {"quality", "flow"})
    attributed.namedAttributes.push_back(testing::randomAttribute(random, name, count));
  attributed.namedAttributes[0] = {"quality", 1, std::vector<float>(count, 0.5f)};
  const Imported read =
      importBytes(writePly(sceneOf({plain, attributed})), "a.ply", {.attributes = {.all = true, .names = {}}});
  const std::vector<NamedAttribute>& attributes = read.scene.meshes.at(0).namedAttributes;
  ASSERT_EQ(attributes.size(), 2u);
  EXPECT_EQ(attributes[0].name, "flow");
  EXPECT_EQ(attributes[0].components, attributed.namedAttributes[1].components);
  EXPECT_EQ(attributes[0].values.back(), attributed.namedAttributes[1].values.back());
  EXPECT_EQ(attributes[1].values.front(), 0);
  EXPECT_EQ(attributes[1].values.back(), 0.5f);
}

TEST(ExportedPly, StatesTheDirectionThatPointsUp) {
  const Scene scene = sceneOf({testing::grid(1)});
  EXPECT_EQ(importBytes(writePly(scene), "a.ply").up, std::nullopt);
  for (const AxisDirection up : {AxisDirection::y, AxisDirection::minusZ})
    EXPECT_EQ(importBytes(writePly(scene, up), "a.ply").up, up);
}

TEST(ExportedPly, HasLinesAsEdges) {
  Mesh mesh = testing::grid(1);
  makeLines(mesh);
  const Bytes ply = writePly(sceneOf({mesh}));
  const std::string_view text = asText(ply);
  EXPECT_NE(text.find("element vertex 4\n"), text.npos);
  EXPECT_NE(text.find("element edge 3\nproperty int vertex1\nproperty int vertex2\nend_header\n"), text.npos);
  EXPECT_EQ(text.find("element face"), text.npos);
  std::vector<std::uint32_t> corners;
  for (std::size_t at = ply.size() - 24; at < ply.size(); at += 4)
    corners.push_back(loadLittle<std::uint32_t>(&ply[at]));
  EXPECT_EQ(corners, mesh.corners);
}

TEST(ExportedObj, IsReadBackByOurImport) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    Mesh mesh = randomMesh(seed), other = randomMesh(seed + 1000);
    if (mesh.topology != Topology::triangles || other.topology != Topology::triangles)
      continue;
    SCOPED_TRACE(seed);
    for (Mesh* each : {&mesh, &other}) // OBJ leaves out alpha
      for (Rgba& color : each->colors)
        color.a = 1;
    const Scene scene = sceneOf({mesh, other});
    const Imported read = importBytes(exportScene(scene, MeshFormat::obj), "a.obj");
    ASSERT_EQ(shapeNodes(read.scene.graph).size(), 2u);
    EXPECT_EQ(shapeName(read.scene.graph, 0), "part0");
    EXPECT_EQ(shapeName(read.scene.graph, 1), "part1");
    expectEqual(cornersOf(read.scene), cornersOf(scene));
  }
}

TEST(ExportedObj, HasLinesAndPoints) {
  Mesh lines{{}, "", Topology::lines, {{0, 0, 0}, {1, 0, 0}}, {0, 1}, {0, 1}};
  lines.texCoords = {{0, 0}, {1, 0.5f}};
  Mesh points{{}, "", Topology::points, {{7, 8, 9}}, {0}, {0}};
  points.colors = {Rgba8{255, 0, 51, 255}};
  Scene scene = sceneOf({lines, points});
  scene.graph.nodes[1].name = "two\nlines";
  EXPECT_EQ(asText(writeObj(scene)), "o part0\nv 0 0 0\nv 1 0 0\nvt 0 0\nvt 1 0.5\nl 1/1 2/2\n"
                                     "o two lines\nv 7 8 9 1 0 0.2\np 3\n");
}

/// The scene that Assimp reads from a GLB; null if Assimp refuses it.
const aiScene* readGlb(Assimp::Importer& importer, const Bytes& glb) {
  return importer.ReadFileFromMemory(glb.data(), glb.size(), 0, "glb");
}

std::vector<Corner> cornersOf(const aiMesh& mesh, unsigned perElement) {
  std::vector<Corner> corners;
  for (unsigned face = 0; face < mesh.mNumFaces; ++face) {
    EXPECT_EQ(mesh.mFaces[face].mNumIndices, perElement);
    for (unsigned i = 0; i < mesh.mFaces[face].mNumIndices; ++i) {
      const unsigned vertex = mesh.mFaces[face].mIndices[i];
      const aiVector3D& p = mesh.mVertices[vertex];
      Corner corner;
      corner.position = {p.x, p.y, p.z};
      if (mesh.HasNormals())
        corner.normal = {mesh.mNormals[vertex].x, mesh.mNormals[vertex].y, mesh.mNormals[vertex].z};
      if (mesh.HasTextureCoords(0)) {
        const aiVector3D& t = mesh.mTextureCoords[0][vertex];
        corner.texCoord = {t.x, t.y};
      }
      if (mesh.HasVertexColors(0)) {
        const auto byte = [](double linear) {
          const double srgb = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
          return static_cast<std::uint8_t>(std::lround(srgb * 255));
        };
        const aiColor4D& c = mesh.mColors[0][vertex];
        corner.color = {byte(c.r), byte(c.g), byte(c.b), static_cast<std::uint8_t>(std::lround(c.a * 255))};
      }
      corners.push_back(corner);
    }
  }
  return corners;
}

TEST(ExportedGlb, IsReadByAssimp) {
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Mesh first = randomMesh(seed), second = randomMesh(seed + 1000);
    if (seed % 10 == 0)
      makeLines(second);
    const Scene scene = sceneOf({first, second});
    Assimp::Importer importer;
    const aiScene* read = readGlb(importer, exportScene(scene, MeshFormat::glb));
    ASSERT_NE(read, nullptr) << importer.GetErrorString();
    ASSERT_EQ(read->mNumMeshes, 2u);
    for (unsigned i = 0; i < 2; ++i) {
      const Mesh& written = scene.meshes[i];
      EXPECT_STREQ(read->mMeshes[i]->mName.C_Str(), shapeName(scene.graph, i).c_str());
      std::vector<Corner> corners = cornersOf(*read->mMeshes[i], cornersPerElement(written.topology));
      const std::vector<Corner> expected = cornersOf(written);
      ASSERT_EQ(corners.size(), expected.size());
      for (std::size_t c = 0; c < corners.size(); ++c) { // computing 1 - v twice rounds
        EXPECT_NEAR(corners[c].texCoord.y, expected[c].texCoord.y, 2e-7);
        corners[c].texCoord = expected[c].texCoord;
      }
      expectEqual(corners, expected);
    }
  }
}

TEST(ExportedGlb, KeepsTheMaterial) {
  Scene scene = sceneOf({testing::grid(2)});
  setAppearance(scene, Material{.diffuseColor{1, 0, 0.5f}, .transparency = 0.25f});
  Assimp::Importer importer;
  const aiScene* read = readGlb(importer, writeGlb(scene));
  ASSERT_NE(read, nullptr) << importer.GetErrorString();
  aiColor4D color;
  ASSERT_EQ(read->mMaterials[read->mMeshes[0]->mMaterialIndex]->Get(AI_MATKEY_COLOR_DIFFUSE, color), aiReturn_SUCCESS);
  EXPECT_NEAR(color.r, 1, 1e-6);
  EXPECT_NEAR(color.g, 0, 1e-6);
  EXPECT_NEAR(color.b, 0.2140, 1e-4); // 0.5 in sRGB
  EXPECT_NEAR(color.a, 0.75, 1e-6);
}

TEST(ExportedGlb, KeepsNamedAttributes) {
  testing::Random random(8);
  Mesh mesh = testing::torus(4, 5);
  for (std::uint32_t components = 1; components <= 4; ++components) {
    NamedAttribute attribute{fmt::format("field{}", components), components, {}};
    for (std::size_t i = 0; i < mesh.wedgeCount() * components; ++i)
      attribute.values.push_back(random.between(-5, 5));
    mesh.namedAttributes.push_back(attribute);
  }
  const Bytes glb = writeGlb(sceneOf({mesh}));
  EXPECT_NE(asText(glb).find("\"_field3\""), std::string::npos); // glTF 2.0, 3.7.2.1: an underscore first
  const Imported read = importBytes(glb, "a.glb", {.attributes = {.all = true, .names = {}}});
  const Mesh& back = read.scene.meshes.at(0);
  ASSERT_EQ(back.namedAttributes.size(), 4u);
  for (std::size_t a = 0; a < 4; ++a) { // compared by corner, since the reader renumbers wedges
    const NamedAttribute &found = back.namedAttributes[a], &written = mesh.namedAttributes[a];
    EXPECT_EQ(found.name, written.name);
    ASSERT_EQ(found.components, a + 1);
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
      for (std::size_t c = 0; c <= a; ++c)
        EXPECT_EQ(found.values[back.corners[corner] * (a + 1) + c], written.values[mesh.corners[corner] * (a + 1) + c]);
  }
}

TEST(ExportedGlb, HoldsMoreVerticesThanFit16BitIndices) {
  const Mesh mesh = testing::grid(300);
  ASSERT_GT(mesh.wedgeCount(), 65536u);
  Assimp::Importer importer;
  const aiScene* read = readGlb(importer, writeGlb(sceneOf({mesh})));
  ASSERT_NE(read, nullptr) << importer.GetErrorString();
  expectEqual(cornersOf(*read->mMeshes[0], 3), cornersOf(mesh));
}

TEST(ExportedGlb, HasChunksOfWholeWordsAndItsLengthInTheHeader) {
  const Bytes glb = writeGlb(sceneOf({testing::torus(3, 3)}));
  EXPECT_EQ(loadLittle<std::uint32_t>(&glb[8]), glb.size());
  const std::uint32_t json = loadLittle<std::uint32_t>(&glb[12]);
  EXPECT_EQ(json % 4, 0u);
  EXPECT_EQ(20 + json + 8 + loadLittle<std::uint32_t>(&glb[20 + json]), glb.size());
}

TEST(ExportedGlb, KeepsViewpoints) {
  Scene scene = sceneOf({testing::sphere(4, 6)});
  Viewpoint viewpoint;
  viewpoint.description = "Door";
  viewpoint.position = {1, 2, 3};
  viewpoint.orientation = {{0, 1, 0}, 0.5};
  viewpoint.fieldOfView = 1.25;
  addRoot(scene.graph, {"", viewpoint, {}, ""});
  const Imported read = importBytes(exportScene(scene, MeshFormat::glb), "a.glb");
  for (const Node& node : read.scene.graph.nodes)
    if (const Viewpoint* back = std::get_if<Viewpoint>(&node.content)) {
      EXPECT_EQ(back->description, "Door");
      EXPECT_EQ(back->fieldOfView, 1.25);
      return;
    }
  ADD_FAILURE() << "the viewpoint is lost";
}

TEST(ExportedGlb, MergesAShapeAndItsTransformIntoOneNodeUnlessBothHaveNames) {
  Scene scene = sceneOf({testing::sphere(4, 6)});
  scene.graph.roots.clear();
  const std::size_t seat = addNode(scene.graph, {"seat", Shape{0, {}, true}, {}, ""});
  const auto addSeat = [&](const char* name, double x) {
    Transform transform;
    transform.translation = {x, 0, 0};
    addRoot(scene.graph, {name, transform, {seat}, ""});
  };
  addSeat("", 1);
  addSeat("", 2);
  addSeat("row", 3);
  const SceneGraph read = importBytes(exportScene(scene, MeshFormat::glb), "a.glb").scene.graph;
  std::vector<std::string> names;
  std::vector<double> positions;
  for (const std::size_t root : read.roots) {
    names.push_back(read.nodes[root].name);
    positions.push_back(std::get<Transform>(read.nodes[root].content).translation.x);
  }
  EXPECT_EQ(names, (std::vector<std::string>{"seat", "seat-2", "row"}));
  EXPECT_EQ(positions, (std::vector<double>{1, 2, 3}));
  const Node& inRow = read.nodes[read.nodes[read.roots[2]].children.at(0)];
  EXPECT_EQ(inRow.name, "seat-3");
  EXPECT_EQ(inRow.children, read.nodes[read.roots[0]].children) << "all instances use one shape";
}

TEST(ExportedGlb, KeepsTheLightsThatGltfCanExpress) {
  Scene scene = sceneOf({testing::sphere(4, 6)});
  const Vec3d bySquare{0, 0, 1};
  addRoot(scene.graph, {"sun", DirectionalLight{{1, -2, 0.5}, {1, 0.5f, 0.25f}, 2, true}, {}, ""});
  addRoot(scene.graph, {"lamp", PointLight{{1, 2, 3}, bySquare, 12, {0, 1, 0}, 3, true}, {}, ""});
  addRoot(scene.graph, {"spot", SpotLight{{4, 5, 6}, {0, -1, 0}, 0.3, 0.5, bySquare, 9, {1, 1, 1}, 4, true}, {}, ""});
  addRoot(scene.graph, {"near", DirectionalLight{}, {}, ""}); // lights its group only
  addRoot(scene.graph, {"even", PointLight{}, {}, ""});       // has no falloff
  EXPECT_EQ(lightsLeftOut(scene.graph), 2u);
  const Imported read = importBytes(exportScene(scene, MeshFormat::glb), "a.glb");
  std::map<std::string, NodeContent> lights;
  for (const Node& node : read.scene.graph.nodes)
    if (const Transform* transform = std::get_if<Transform>(&node.content)) {
      NodeContent light = read.scene.graph.nodes.at(node.children.at(0)).content;
      const Affine3d map = affineOf(*transform);
      if (auto* sun = std::get_if<DirectionalLight>(&light))
        sun->direction = map.direction(sun->direction);
      if (auto* lamp = std::get_if<PointLight>(&light))
        lamp->location = map.point(lamp->location);
      if (auto* spot = std::get_if<SpotLight>(&light)) {
        spot->location = map.point(spot->location);
        spot->direction = map.direction(spot->direction);
      }
      lights[node.name] = light;
    }
  ASSERT_EQ(lights.size(), 3u);
  const auto& sun = std::get<DirectionalLight>(lights.at("sun"));
  EXPECT_LT(length(sun.direction - Vec3d{1, -2, 0.5} * (1 / length(Vec3d{1, -2, 0.5}))), 1e-7);
  EXPECT_EQ(sun.color, (Vec3f{1, 0.5f, 0.25f}));
  EXPECT_EQ(sun.intensity, 2);
  const auto& lamp = std::get<PointLight>(lights.at("lamp"));
  EXPECT_LT(length(lamp.location - Vec3d{1, 2, 3}), 1e-7);
  EXPECT_EQ(lamp.radius, 12);
  const auto& spot = std::get<SpotLight>(lights.at("spot"));
  EXPECT_LT(length(spot.location - Vec3d{4, 5, 6}), 1e-7);
  EXPECT_LT(length(spot.direction - Vec3d{0, -1, 0}), 1e-7);
  EXPECT_EQ(spot.beamWidth, 0.3);
  EXPECT_EQ(spot.cutOffAngle, 0.5);
}

} // namespace
} // namespace imgeo
