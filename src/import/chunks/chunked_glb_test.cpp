#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/chunks/chunked_source.h"
#include "import/gltf/testing.h"
#include "scene/testing.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::GltfText;
using testing::TemporaryDirectory;

constexpr std::uint32_t vertexCount = 700, triangleCount = 1100;

/// A document of one primitive with attributes of several types. `indexType`: of the indices; 0: none.
GltfText scattered(int indexType, int mode) {
  testing::Random random(5);
  GltfText gltf;
  std::vector<float> positions, normals, values;
  std::vector<std::uint16_t> texCoords;
  std::vector<std::uint8_t> colors;
  for (std::uint32_t i = 0; i < vertexCount; ++i) {
    const Vec3f at = random.point(), normal = random.direction();
    positions.insert(positions.end(), {at.x, at.y, at.z});
    normals.insert(normals.end(), {normal.x, normal.y, normal.z});
    values.push_back(at.x * at.y);
    for (int c = 0; c < 2; ++c)
      texCoords.push_back(static_cast<std::uint16_t>(random.below(65536)));
    for (int c = 0; c < 4; ++c)
      colors.push_back(static_cast<std::uint8_t>(random.below(256)));
  }
  GltfText::Json primitive = {{"mode", mode},
                              {"attributes",
                               {{"POSITION", gltf.addAccessor(positions, "VEC3", 5126)},
                                {"NORMAL", gltf.addAccessor(normals, "VEC3", 5126)},
                                {"TEXCOORD_0", gltf.addAccessor(texCoords, "VEC2", 5123, true)},
                                {"COLOR_0", gltf.addAccessor(colors, "VEC4", 5121, true)},
                                {"_HEAT", gltf.addAccessor(values, "SCALAR", 5126)}}}};
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i < 3 * triangleCount + 1; ++i)
    indices.push_back(random.below(vertexCount));
  if (indexType == 5123)
    primitive["indices"] =
        gltf.addAccessor(std::vector<std::uint16_t>(indices.begin(), indices.end()), "SCALAR", indexType);
  else if (indexType != 0)
    primitive["indices"] = gltf.addAccessor(indices, "SCALAR", indexType);
  const std::size_t mesh = gltf.addMesh({primitive});
  gltf.addNode({{"name", "house"}, {"translation", {1, 2, 3}}, {"children", {1}}});
  gltf.addNode({{"name", "house"}, {"mesh", mesh}, {"scale", {2, 2, 2}}});
  return gltf;
}

/// The positions and attributes of all corners.
std::vector<float> cornersOf(const Mesh& mesh) {
  std::vector<float> values;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
    const std::uint32_t wedge = mesh.corners[corner];
    const Vec3f &at = mesh.cornerPosition(corner), &normal = mesh.normals.at(wedge);
    const Vec2f& texCoord = mesh.texCoords.at(wedge);
    const Rgba& color = mesh.colors.at(wedge);
    values.insert(values.end(), {at.x, at.y, at.z, normal.x, normal.y, normal.z, texCoord.x, texCoord.y, color.r,
                                 color.g, color.b, color.a, mesh.namedAttributes.at(0).values.at(wedge)});
  }
  return values;
}

/// Those of all pieces of a mesh.
std::vector<float> cornersOfPieces(const ChunkedMesh& pieces, const ImportOptions& options) {
  std::vector<float> values;
  std::uint64_t count = 0;
  for (std::size_t chunk = 0; chunk < pieces.chunkCount(); ++chunk) {
    const Imported piece = pieces.read(chunk, options);
    const Mesh& mesh = piece.scene.meshes.at(0);
    EXPECT_EQ(mesh.elementCount(), pieces.elementsOf(chunk));
    EXPECT_EQ(pieces.firstElementOf(chunk), count);
    count += pieces.elementsOf(chunk);
    const std::vector<float> corners = cornersOf(mesh);
    values.insert(values.end(), corners.begin(), corners.end());
  }
  EXPECT_EQ(count, pieces.elementCount());
  return values;
}

void expectSameScene(const Imported& scene, const Imported& whole) {
  const SceneGraph &graph = scene.scene.graph, &expected = whole.scene.graph;
  ASSERT_EQ(graph.nodes.size(), expected.nodes.size());
  for (std::size_t i = 0; i < expected.nodes.size(); ++i) {
    EXPECT_EQ(graph.nodes[i].name, expected.nodes[i].name);
    EXPECT_EQ(graph.nodes[i].children, expected.nodes[i].children);
  }
  ASSERT_EQ(shapeNodes(graph), shapeNodes(expected));
  for (const std::size_t shape : shapeNodes(graph)) {
    EXPECT_EQ(shapeOf(graph, shape).mesh, shapeOf(expected, shape).mesh);
    EXPECT_EQ(shapeOf(graph, shape).appearance, shapeOf(expected, shape).appearance);
  }
  EXPECT_EQ(graph.title, expected.title);
  EXPECT_EQ(scene.metres, whole.metres);
  EXPECT_EQ(scene.up, whole.up);
  EXPECT_EQ(scene.attributes, whole.attributes);
  EXPECT_EQ(scene.warnings, whole.warnings);
}

TEST(ChunkedGlb, HasTheElementsAndTheSceneOfTheFile) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  for (const int mode : {4, 0})
    for (const int indexType : {5123, 5125, 0}) {
      const TemporaryDirectory directory;
      const std::filesystem::path file = directory / "a.glb";
      writeFile(file, scattered(indexType, mode).glb());
      const auto source = ChunkedSource::open(file, directory.path(), 100);
      ASSERT_EQ(source->meshCount(), 1u);
      const ChunkedMesh pieces = source->mesh(0);
      EXPECT_GE(pieces.chunkCount(), indexType == 0 && mode == 4 ? 3u : 7u);
      EXPECT_EQ(pieces.topology(), mode == 0 ? Topology::points : Topology::triangles);
      const Imported whole = importFile(file, options), scene = source->readScene({}, options);
      EXPECT_TRUE(cornersOfPieces(pieces, options) == cornersOf(whole.scene.meshes.at(0))) << indexType << ' ' << mode;
      expectSameScene(scene, whole);
      EXPECT_EQ(scene.scene.meshes.at(0).elementCount(), 1u);
    }
}

TEST(ChunkedGlb, WarnsOfVerticesThatMakeNoWholeTriangleOrRefusesThemIfStrict) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.glb";
  writeFile(file, scattered(5125, 4).glb());
  ImportOptions options{.attributes = {.all = true, .names = {}}};
  const auto source = ChunkedSource::open(file, directory.path(), 100);
  const std::vector<std::string> expected = {
      "1 vertex or index is not carried over: a whole triangle or line needs more."};
  EXPECT_EQ(importFile(file, options).warnings, expected);
  EXPECT_EQ(source->readScene({}, options).warnings, expected);
  EXPECT_EQ(source->readScene({0}, options).warnings, expected);
  options.strict = true;
  EXPECT_THROW(source->readScene({}, options), Error);
  EXPECT_THROW(source->readScene({0}, options), Error);
}

TEST(ChunkedGlb, RefusesWhatItDoesNotReadInPieces) {
  const TemporaryDirectory directory;
  const auto expectRefused = [&](const char* words, const std::function<void(GltfText&)>& change) {
    GltfText gltf = scattered(5125, 4);
    change(gltf);
    writeFile(directory / "a.glb", gltf.glb());
    try {
      ChunkedSource::open(directory / "a.glb", directory.path());
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::unsupported) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  const auto primitiveOf = [](GltfText& gltf) -> GltfText::Json& { return gltf.json["meshes"][0]["primitives"][0]; };
  expectRefused("has lines, strips or fans", [&](GltfText& gltf) { primitiveOf(gltf)["mode"] = 5; });
  expectRefused("has a skin", [](GltfText& gltf) { gltf.json["nodes"][1]["skin"] = 0; });
  expectRefused("has morph targets", [&](GltfText& gltf) { primitiveOf(gltf)["targets"] = {{{"POSITION", 0}}}; });
  expectRefused("is compressed by Draco", [&](GltfText& gltf) {
    primitiveOf(gltf)["extensions"]["KHR_draco_mesh_compression"] = GltfText::Json::object();
  });
  expectRefused("is compressed by meshopt", [](GltfText& gltf) {
    gltf.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = GltfText::Json::object();
  });
  expectRefused("has sparse accessors", [](GltfText& gltf) { gltf.json["accessors"][0]["sparse"] = {{"count", 0}}; });
  writeFile(directory / "a.gltf", asBytes(scattered(5125, 4).text()));
  EXPECT_THROW(ChunkedSource::open(directory / "a.gltf", directory.path()), Error);
}

/// Three primitives in two meshes: one of each other material, one without, which two nodes show; and one that none
/// shows.
GltfText severalPrimitives() {
  GltfText gltf = scattered(5125, 4);
  GltfText::Json& first = gltf.json["meshes"][0]["primitives"][0];
  GltfText::Json part = first, points = first;
  gltf.json["accessors"].push_back(gltf.json["accessors"][first["indices"].get<std::size_t>()]);
  gltf.json["accessors"].back()["count"] = 3 * (triangleCount / 2);
  part["indices"] = gltf.json["accessors"].size() - 1;
  part["material"] = 0;
  points["mode"] = 0;
  first["material"] = 1;
  GltfText::Json same = first;
  same["material"] = 0;
  gltf.json["materials"] = {{{"name", "stone"}}, {{"name", "wood"}}};
  gltf.json["meshes"][0]["primitives"].push_back(part);
  gltf.json["meshes"][0]["primitives"].push_back(same);
  gltf.json["nodes"][0]["children"] = {1, 2, 3};
  gltf.addNode({{"name", "again"}, {"mesh", 0}, {"scale", {3, 2, 2}}});
  gltf.addNode({{"name", "cloud"}, {"mesh", gltf.addMesh({points})}});
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  gltf.addTriangle();
  return gltf;
}

TEST(ChunkedGlb, ReadsEachMeshThatIsShownOnce) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.glb";
  writeFile(file, severalPrimitives().glb());
  const auto source = ChunkedSource::open(file, directory.path(), 100);
  const Imported whole = importFile(file, options);
  ASSERT_EQ(source->meshCount(), 3u);
  EXPECT_EQ(source->elementCount(), triangleCount + triangleCount / 2 + 3 * triangleCount + 1);
  expectSameScene(source->readScene({}, options), whole);
  const Imported scene = source->readScene({1}, options);
  expectSameScene(scene, whole);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(cornersOfPieces(source->mesh(i), options) == cornersOf(whole.scene.meshes.at(i))) << i;
    EXPECT_EQ(source->mesh(i).topology(), whole.scene.meshes[i].topology);
    EXPECT_EQ(scene.scene.meshes.at(i).elementCount(), i == 1 ? triangleCount / 2 : 1);
  }
  EXPECT_EQ(scene.scene.meshes[1].corners, whole.scene.meshes[1].corners);
}

TEST(ChunkedGlb, ReadsMeshesWithoutTheScene) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.glb";
  writeFile(file, severalPrimitives().glb());
  const auto source = ChunkedSource::open(file, directory.path(), 100);
  const Imported whole = importFile(file, options), read = source->readMeshes({0, 2}, options);
  ASSERT_EQ(read.scene.meshes.size(), 2u);
  EXPECT_EQ(read.attributes, whole.attributes);
  for (const std::size_t i : {0, 1}) {
    EXPECT_EQ(read.scene.meshes[i].corners, whole.scene.meshes[2 * i].corners);
    EXPECT_TRUE(cornersOf(read.scene.meshes[i]) == cornersOf(whole.scene.meshes[2 * i]));
  }
}

TEST(ChunkedGlb, ReadsAnimationsInstancesAndImagesAsInAWholeFile) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.glb";
  GltfText gltf = severalPrimitives();
  const std::size_t times = gltf.addAccessor(std::vector<float>{0, 1, 2}, "SCALAR", 5126),
                    positions = gltf.addAccessor(std::vector<float>{0, 0, 0, 1, 2, 3, 4, 5, 6}, "VEC3", 5126);
  gltf.json["animations"] = {{{"samplers", {{{"input", times}, {"output", positions}}}},
                              {"channels", {{{"sampler", 0}, {"target", {{"node", 1}, {"path", "translation"}}}}}}}};
  gltf.json["nodes"][2]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] = positions;
  writeFile(file, gltf.glb());
  const Imported whole = importFile(file), scene = ChunkedSource::open(file, directory.path(), 100)->readScene({}, {});
  EXPECT_EQ(scene.scene.graph.nodes, whole.scene.graph.nodes);
  EXPECT_EQ(scene.scene.graph.routes, whole.scene.graph.routes);
  EXPECT_FALSE(whole.scene.graph.routes.empty());
  EXPECT_EQ(scene.warnings, whole.warnings);
}

TEST(ChunkedGlb, LeavesOutDamagedMeshes) {
  const TemporaryDirectory directory;
  const std::filesystem::path file = directory / "a.glb";
  GltfText gltf = severalPrimitives();
  const std::size_t indices = gltf.json["meshes"][0]["primitives"][0]["indices"];
  const std::size_t view = gltf.json["accessors"][indices]["bufferView"];
  const std::size_t offset = gltf.json["bufferViews"][view]["byteOffset"];
  for (std::size_t i = 0; i < 4; ++i)
    gltf.buffer[offset + std::size_t{12} * triangleCount - 1 - i] = 0xff; // behind the other half of the triangles
  writeFile(file, gltf.glb());
  const Imported whole = importFile(file);
  ASSERT_EQ(whole.scene.meshes.size(), 1u);
  const auto source = ChunkedSource::open(file, directory.path(), 100);
  ASSERT_EQ(source->meshCount(), 3u);
  const Imported scene = source->readScene({0, 1, 2}, {});
  EXPECT_EQ(scene.warnings, whole.warnings);
  ASSERT_EQ(shapeNodes(scene.scene.graph).size(), shapeNodes(whole.scene.graph).size());
  EXPECT_EQ(shapeOf(scene.scene.graph, shapeNodes(scene.scene.graph)[0]).mesh, 1u);
  EXPECT_EQ(scene.scene.meshes.at(1).corners, whole.scene.meshes.at(0).corners);
  const Imported meshes = source->readMeshes({0, 1}, {});
  EXPECT_EQ(meshes.scene.meshes.at(0).elementCount(), 0u);
  EXPECT_EQ(meshes.scene.meshes.at(1).corners, whole.scene.meshes.at(0).corners);
  ASSERT_EQ(meshes.warnings.size(), 1u);
  EXPECT_NE(std::ranges::find(whole.warnings, meshes.warnings[0]), whole.warnings.end());
}

TEST(ChunkedGlb, RefusesIndicesOfNoVertexAndMeshesThatNoNodeShows) {
  const TemporaryDirectory directory;
  const auto expectMalformed = [&](const GltfText& gltf, const char* words) {
    writeFile(directory / "a.glb", gltf.glb());
    try {
      const auto source = ChunkedSource::open(directory / "a.glb", directory.path());
      source->mesh(0).read(0, {});
      ADD_FAILURE() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::malformed) << error.what();
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  GltfText gltf = scattered(5125, 4);
  for (std::size_t i = gltf.buffer.size() - 200; i < gltf.buffer.size(); ++i)
    gltf.buffer[i] = 0xff;
  for (GltfText::Json& accessor : gltf.json["accessors"]) // only the last piece is read
    if (accessor["type"] == "SCALAR" && accessor["componentType"] == 5125)
      accessor["byteOffset"] = 4 * (3 * triangleCount - 60), accessor["count"] = 60;
  expectMalformed(gltf, "name vertex");
  gltf = scattered(5125, 4);
  gltf.json["nodes"][1].erase("mesh");
  expectMalformed(gltf, "the file has no triangles");
}

} // namespace
} // namespace imgeo
