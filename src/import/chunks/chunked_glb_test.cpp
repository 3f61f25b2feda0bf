#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/chunks/chunked_source.h"
#include "import/gltf/testing.h"
#include "scene/testing.h"

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

TEST(ChunkedGlb, HasTheElementsAndTheSceneOfTheFile) {
  const ImportOptions options{.attributes = {.all = true, .names = {}}};
  for (const int mode : {4, 0})
    for (const int indexType : {5123, 5125, 0}) {
      const TemporaryDirectory directory;
      const std::filesystem::path file = directory / "a.glb";
      writeFile(file, scattered(indexType, mode).glb());
      const auto source = ChunkedSource::open(file, directory.path(), 100);
      EXPECT_GE(source->chunkCount(), indexType == 0 && mode == 4 ? 3u : 7u);
      EXPECT_EQ(source->topology(), mode == 0 ? Topology::points : Topology::triangles);
      std::vector<float> pieces;
      std::uint64_t count = 0;
      for (std::size_t chunk = 0; chunk < source->chunkCount(); ++chunk) {
        const Imported piece = source->read(chunk, options);
        const Mesh& mesh = piece.scene.meshes.at(0);
        EXPECT_EQ(mesh.elementCount(), source->elementsOf(chunk));
        count += source->elementsOf(chunk);
        const std::vector<float> corners = cornersOf(mesh);
        pieces.insert(pieces.end(), corners.begin(), corners.end());
      }
      EXPECT_EQ(count, source->elementCount());
      const Imported whole = importFile(file, options), first = source->read(0, options);
      EXPECT_TRUE(pieces == cornersOf(whole.scene.meshes.at(0))) << indexType << ' ' << mode;
      EXPECT_EQ(first.scene.graph.nodes.size(), whole.scene.graph.nodes.size());
      for (std::size_t i = 0; i < whole.scene.graph.nodes.size(); ++i)
        EXPECT_EQ(first.scene.graph.nodes[i].name, whole.scene.graph.nodes[i].name);
      EXPECT_EQ(first.scene.graph.title, whole.scene.graph.title);
      EXPECT_EQ(first.metres, whole.metres);
      EXPECT_EQ(first.up, whole.up);
      EXPECT_EQ(first.attributes, whole.attributes);
      EXPECT_EQ(first.warnings, whole.warnings);
    }
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
  expectRefused("has several meshes", [](GltfText& gltf) { gltf.addTriangle(); });
  expectRefused("has several primitives", [&](GltfText& gltf) {
    const GltfText::Json same = primitiveOf(gltf);
    gltf.json["meshes"][0]["primitives"].push_back(same);
  });
  expectRefused("has no mesh", [](GltfText& gltf) { gltf.json["meshes"].clear(); });
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

TEST(ChunkedGlb, RefusesIndicesOfNoVertexAndMeshesThatNoNodeShows) {
  const TemporaryDirectory directory;
  const auto expectMalformed = [&](const GltfText& gltf, const char* words) {
    writeFile(directory / "a.glb", gltf.glb());
    try {
      const auto source = ChunkedSource::open(directory / "a.glb", directory.path());
      source->read(0, {});
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
  expectMalformed(gltf, "no node");
}

} // namespace
} // namespace imgeo
