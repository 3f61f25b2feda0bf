#include "import/gltf/testing.h"
#include "import/testing.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

namespace imgeo::testing {
namespace {

using Json = GltfText::Json;

Mesh onlyMeshOf(const GltfText& gltf, const ImportOptions& options = {}) {
  const Imported imported = read(gltf, options);
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
  EXPECT_TRUE(isConsistent(imported.scene.meshes.at(0)));
  return imported.scene.meshes.at(0);
}

std::vector<Vec3f> cornersOf(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    corners.push_back(mesh.cornerPosition(corner));
  return corners;
}

/// The corners of a primitive of this mode as vertex indices: the x of each vertex is its index.
std::vector<int> cornersOfMode(int mode) {
  GltfText gltf;
  const std::size_t positions = gltf.addAccessor<float>({0, 0, 0, 1, 5, 0, 2, 0, 0, 3, 5, 0, 4, 0, 0}, "VEC3", 5126);
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", positions}}}, {"mode", mode}}}));
  std::vector<int> vertices;
  for (const Vec3f corner : cornersOf(onlyMeshOf(gltf)))
    vertices.push_back(static_cast<int>(corner.x));
  return vertices;
}

TEST(GltfPrimitive, OfEveryModeBecomesSeparateElements) {
  using List = std::vector<int>;
  EXPECT_EQ(cornersOfMode(0), (List{0, 1, 2, 3, 4}));
  EXPECT_EQ(cornersOfMode(1), (List{0, 1, 2, 3}));
  EXPECT_EQ(cornersOfMode(2), (List{0, 1, 1, 2, 2, 3, 3, 4, 4, 0}));
  EXPECT_EQ(cornersOfMode(3), (List{0, 1, 1, 2, 2, 3, 3, 4}));
  EXPECT_EQ(cornersOfMode(4), (List{0, 1, 2}));
  EXPECT_EQ(cornersOfMode(5), (List{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(cornersOfMode(6), (List{1, 2, 0, 2, 3, 0, 3, 4, 0}));
}

TEST(GltfPrimitive, WithVerticesThatMakeNoWholeTriangleIsDrawnWithoutThemOrRefusedIfStrict) {
  GltfText gltf;
  const std::size_t positions = gltf.addAccessor<float>({0, 0, 0, 1, 5, 0, 2, 0, 0}, "VEC3", 5126);
  const std::size_t indices = gltf.addAccessor<std::uint8_t>({0, 1, 2, 2, 1}, "SCALAR", 5121);
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}));
  const Imported imported = read(gltf);
  EXPECT_EQ(imported.scene.meshes[0].corners.size(), 3u);
  EXPECT_EQ(imported.warnings, std::vector<std::string>{
                                   "2 vertices or indices are not carried over: a whole triangle or line needs more."});
  ImportOptions strict;
  strict.strict = true;
  EXPECT_THROW(read(gltf, strict), Error);
}

TEST(GltfPrimitive, WithoutNormalsHasFlatTriangles) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  EXPECT_EQ(onlyMeshOf(gltf).creaseDegrees, 0);
}

TEST(GltfPrimitive, ReadsEveryTypeOfNumber) {
  GltfText gltf;
  const std::size_t positions = gltf.addAccessor<std::int16_t>({-1, 0, 0, 300, 0, 0, 0, 4, 0}, "VEC3", 5122);
  const std::size_t normals = gltf.addAccessor<std::int8_t>({0, 0, 127, 0, -127, 0, -128, 0, 0}, "VEC3", 5120, true);
  const std::size_t texCoords = gltf.addAccessor<std::uint16_t>({0, 65535, 65535, 0, 0, 0}, "VEC2", 5123, true);
  const std::size_t colors =
      gltf.addAccessor<std::uint8_t>({255, 0, 0, 255, 0, 255, 0, 51, 0, 0, 0, 255}, "VEC4", 5121, true);
  const std::size_t indices = gltf.addAccessor<std::uint8_t>({2, 1, 0}, "SCALAR", 5121);
  gltf.show(gltf.addMesh(
      {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", texCoords}, {"COLOR_0", colors}}},
        {"indices", indices}}}));
  const Mesh mesh = onlyMeshOf(gltf);
  EXPECT_EQ(cornersOf(mesh), (std::vector<Vec3f>{{0, 4, 0}, {300, 0, 0}, {-1, 0, 0}}));
  EXPECT_EQ(mesh.normals[2], (Vec3f{0, 0, 1}));
  EXPECT_EQ(mesh.normals[0], (Vec3f{-1, 0, 0}));
  EXPECT_EQ(mesh.texCoords[2], (Vec2f{0, 0})); // v is measured up
  EXPECT_EQ(mesh.texCoords[1], (Vec2f{1, 1}));
  EXPECT_EQ(asRgba8(mesh.colors[1]), (Rgba8{0, 255, 0, 51}));
  EXPECT_EQ(mesh.colorComponents, 4u);
}

/// A triangle with texture coordinates of the sets 0 to 4, whose u is the number of the set, and a material whose
/// textures use the sets 0, 2 and, by their transform, 4.
GltfText withTexCoordSets() {
  GltfText gltf;
  gltf.addTriangle();
  GltfText::Json& primitive = gltf.json["meshes"][0]["primitives"][0];
  for (const int set : {0, 1, 2, 3, 4}) {
    const auto u = static_cast<float>(set);
    primitive["attributes"]["TEXCOORD_" + std::to_string(set)] =
        gltf.addAccessor<float>({u, 0, u, 1, u, 0.5f}, "VEC2", 5126);
  }
  primitive["material"] = 0;
  gltf.json["images"] = {{{"uri", GltfText::dataUrl({0x89, 'P', 'N', 'G', 13, 10, 26, 10})}}};
  gltf.json["textures"] = {{{"source", 0}}};
  gltf.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
       {"occlusionTexture", {{"index", 0}, {"texCoord", 2}}},
       {"emissiveTexture",
        {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 4}}}}}}}}};
  return gltf.show(0);
}

TEST(GltfPrimitive, KeepsTheTextureCoordinatesThatTexturesUse) {
  const Imported imported = read(withTexCoordSets());
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_TRUE(isConsistent(mesh));
  ASSERT_EQ(texCoordSetCount(mesh), 3u);
  EXPECT_EQ(mesh.texCoords[1], (Vec2f{0, 0}));
  EXPECT_EQ(mesh.texCoords1[1], (Vec2f{2, 0}));
  EXPECT_EQ(mesh.texCoords2[1], (Vec2f{4, 0}));
  EXPECT_EQ(mesh.texCoordMappings, (std::vector<std::string>{"", "TEXCOORD_2", "TEXCOORD_4"}));
  std::map<TextureRole, std::size_t> sets;
  for (const TextureUse& use : imported.scene.graph.appearances.at(0).textures)
    sets[use.role] = texCoordSetNamed(use.mapping, mesh);
  EXPECT_EQ(sets, (std::map<TextureRole, std::size_t>{
                      {TextureRole::color, 0}, {TextureRole::emissive, 2}, {TextureRole::occlusion, 1}}));
}

TEST(GltfPrimitive, KeepsTheFirstFourSetsOfTextureCoordinatesOfAllIfAsked) {
  ImportOptions options;
  options.attributes.all = true;
  const Mesh mesh = onlyMeshOf(withTexCoordSets(), options);
  ASSERT_EQ(texCoordSetCount(mesh), 4u);
  EXPECT_EQ(mesh.texCoords3[1], (Vec2f{3, 0}));
}

TEST(GltfPrimitive, ConvertsLinearColoursToSrgb) {
  GltfText gltf;
  gltf.addTriangle();
  const std::size_t colors = gltf.addAccessor<float>({0.2140f, 1, 0, 7, -1, 0.5f, 0, 0, 0}, "VEC3", 5126);
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = colors;
  const Mesh mesh = onlyMeshOf(gltf.show(0));
  EXPECT_EQ(asRgba8(mesh.colors[0]), (Rgba8{127, 255, 0, 255}));
  EXPECT_EQ(asRgba8(mesh.colors[1]), (Rgba8{255, 0, 188, 255}));
  EXPECT_EQ(mesh.colorComponents, 3u);
}

TEST(GltfPrimitive, ReadsInterleavedAndSparseAccessors) {
  GltfText gltf;
  Bytes interleaved;
  for (const float value : {0.f, 0.f, 0.f, 9.f, 1.f, 0.f, 0.f, 9.f, 0.f, 1.f, 0.f, 9.f})
    appendLittle(interleaved, value);
  const std::size_t view = gltf.addView(interleaved);
  gltf.json["bufferViews"][view]["byteStride"] = 16;
  Bytes where, values;
  appendLittle(where, std::uint16_t{2});
  for (const float value : {5.f, 6.f, 7.f})
    appendLittle(values, value);
  gltf.json["accessors"].push_back({{"bufferView", view},
                                    {"componentType", 5126},
                                    {"type", "VEC3"},
                                    {"count", 3},
                                    {"sparse",
                                     {{"count", 1},
                                      {"indices", {{"bufferView", gltf.addView(where)}, {"componentType", 5123}}},
                                      {"values", {{"bufferView", gltf.addView(values)}}}}}});
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", 0}}}}}));
  EXPECT_EQ(cornersOf(onlyMeshOf(gltf)), (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {5, 6, 7}}));
}

TEST(GltfPrimitive, KeepsTheRequestedAttributes) {
  GltfText gltf;
  gltf.addTriangle();
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["_TEMPERATURE"] =
      gltf.addAccessor<float>({1, 2, 3}, "SCALAR", 5126);
  gltf.show(0);
  EXPECT_TRUE(onlyMeshOf(gltf).namedAttributes.empty());
  const Mesh mesh = onlyMeshOf(gltf, {.attributes = {.all = false, .names = {"TEMPERATURE"}}});
  ASSERT_EQ(mesh.namedAttributes.size(), 1u);
  EXPECT_EQ(mesh.namedAttributes[0], (NamedAttribute{"TEMPERATURE", 1, {1, 2, 3}}));
}

TEST(GltfPrimitive, NamesTheLocationOfAnError) {
  const auto expectLocation = [](const std::string& location, auto damage) {
    GltfText gltf;
    gltf.addTriangle();
    gltf.show(0);
    gltf.json["meshes"][0]["primitives"][0]["indices"] = gltf.addAccessor<std::uint32_t>({0, 1, 2}, "SCALAR", 5125);
    damage(gltf.json);
    try {
      read(gltf, {.attributes = {}, .folder = "", .outside = false, .strict = true});
      ADD_FAILURE() << "was read: " << location;
    } catch (const Error& error) {
      EXPECT_EQ(error.location(), "a.gltf, " + location);
    }
  };
  expectLocation("accessors[0]", [](Json& json) { json["accessors"][0]["count"] = 4; });
  expectLocation("accessors[0].count", [](Json& json) { json["accessors"][0]["count"] = -1; });
  expectLocation("accessors[0].count", [](Json& json) { json["accessors"][0]["count"] = 1e15; });
  expectLocation("accessors[0].type", [](Json& json) { json["accessors"][0]["type"] = "VEC5"; });
  expectLocation("accessors[0].componentType", [](Json& json) { json["accessors"][0]["componentType"] = 5124; });
  expectLocation("accessors[0].bufferView", [](Json& json) { json["accessors"][0]["bufferView"] = 9; });
  expectLocation("bufferViews[0]", [](Json& json) { json["bufferViews"][0]["byteOffset"] = 1000; });
  expectLocation("bufferViews[0].byteStride", [](Json& json) { json["bufferViews"][0]["byteStride"] = 2; });
  expectLocation("meshes[0].primitives[0].indices", [](Json& json) { json["accessors"][1]["componentType"] = 5126; });
  expectLocation("meshes[0].primitives[0].mode", [](Json& json) { json["meshes"][0]["primitives"][0]["mode"] = 7; });
  expectLocation("meshes[0].primitives[0].indices",
                 [](Json& json) { json["meshes"][0]["primitives"][0]["attributes"] = Json::object(); });
  expectLocation("nodes[0].mesh", [](Json& json) { json["nodes"][0]["mesh"] = "first"; });
  expectLocation("nodes[0].scale", [](Json& json) { json["nodes"][0]["scale"] = {1, 2}; });
  expectLocation("extensionsRequired[0]", [](Json& json) { json["extensionsRequired"] = {"KHR_texture_basisu"}; });
}

TEST(GltfPrimitive, IsLeftOutWhereItIsDamaged) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  const std::size_t bad = gltf.addTriangle();
  gltf.json["meshes"][bad]["primitives"][0]["indices"] = gltf.addAccessor<std::uint8_t>({0, 1, 3}, "SCALAR", 5121);
  gltf.show(bad);
  const Imported imported = read(gltf);
  EXPECT_EQ(shapeInstances(imported.scene.graph).size(), 1u);
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_EQ(imported.warnings[0], "Left out: a.gltf, meshes[1].primitives[0].indices: name vertex 3 of 3.");
}

TEST(GltfPrimitive, IsRefusedWhereItExceedsTheBudget) {
  GltfText gltf;
  gltf.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 4000000000u}}); // zeros
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", 0}}}}}));
  EXPECT_EQ(errorOf(gltf.text(), "a.gltf").kind(), ErrorKind::limit);
}

/// A sphere as positions and indices.
struct Arrays {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
};

Arrays sphereArrays() {
  const Mesh mesh = sphere(20, 20);
  Arrays arrays;
  for (const std::uint32_t position : mesh.wedgePositions)
    for (int axis = 0; axis < 3; ++axis)
      arrays.positions.push_back(mesh.positions[position][axis]);
  arrays.indices = mesh.corners;
  return arrays;
}

TEST(GltfPrimitive, IsDecompressedByMeshopt) {
  const Arrays arrays = sphereArrays();
  const std::size_t vertices = arrays.positions.size() / 3;
  Bytes packedVertices(meshopt_encodeVertexBufferBound(vertices, 12)),
      packedIndices(meshopt_encodeIndexBufferBound(arrays.indices.size(), vertices));
  packedVertices.resize(
      meshopt_encodeVertexBuffer(packedVertices.data(), packedVertices.size(), arrays.positions.data(), vertices, 12));
  packedIndices.resize(meshopt_encodeIndexBuffer(packedIndices.data(), packedIndices.size(), arrays.indices.data(),
                                                 arrays.indices.size()));
  GltfText gltf;
  const auto addPacked = [&](const Bytes& packed, std::size_t count, std::size_t stride, const char* mode) {
    const std::size_t view = gltf.addView(packed);
    Json& json = gltf.json["bufferViews"][view];
    json["extensions"]["EXT_meshopt_compression"] = {{"buffer", 0},
                                                     {"byteOffset", json["byteOffset"]},
                                                     {"byteLength", packed.size()},
                                                     {"byteStride", stride},
                                                     {"count", count},
                                                     {"mode", mode}};
    json["buffer"] = 1; // the fallback buffer, which is absent
    return view;
  };
  gltf.json["accessors"] = {{{"bufferView", addPacked(packedVertices, vertices, 12, "ATTRIBUTES")},
                             {"componentType", 5126},
                             {"type", "VEC3"},
                             {"count", vertices}},
                            {{"bufferView", addPacked(packedIndices, arrays.indices.size(), 4, "TRIANGLES")},
                             {"componentType", 5125},
                             {"type", "SCALAR"},
                             {"count", arrays.indices.size()}}};
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}));
  const Mesh mesh = onlyMeshOf(gltf);
  ASSERT_EQ(mesh.corners.size(), arrays.indices.size());
  double area = 0; // the decoder keeps the order of triangles but rotates their corners
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    const Vec3d a(mesh.cornerPosition(corner)), b(mesh.cornerPosition(corner + 1)), c(mesh.cornerPosition(corner + 2));
    area += length(cross(b - a, c - a)) / 2;
  }
  const Mesh expected = sphere(20, 20);
  double expectedArea = 0;
  for (std::size_t corner = 0; corner < expected.corners.size(); corner += 3) {
    const Vec3d a(expected.cornerPosition(corner)), b(expected.cornerPosition(corner + 1)),
        c(expected.cornerPosition(corner + 2));
    expectedArea += length(cross(b - a, c - a)) / 2;
  }
  EXPECT_NEAR(area, expectedArea, 1e-6);
  gltf.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 5;
  EXPECT_EQ(errorOf(gltf.text(), "a.gltf").kind(), ErrorKind::malformed);
}

TEST(GltfPrimitive, IsDecompressedByDraco) {
  const Arrays arrays = sphereArrays();
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(static_cast<int>(arrays.indices.size() / 3));
  const int attribute = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  for (std::size_t face = 0; face < arrays.indices.size() / 3; ++face)
    builder.SetAttributeValuesForFace(
        attribute, draco::FaceIndex(static_cast<std::uint32_t>(face)), &arrays.positions[3 * arrays.indices[3 * face]],
        &arrays.positions[3 * arrays.indices[3 * face + 1]], &arrays.positions[3 * arrays.indices[3 * face + 2]]);
  const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
  draco::EncoderBuffer encoded;
  draco::Encoder encoder;
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  ASSERT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &encoded).ok());

  GltfText gltf;
  const std::size_t view = gltf.addView(Bytes(encoded.data(), encoded.data() + encoded.size()));
  gltf.json["accessors"] = {{{"componentType", 5126}, {"type", "VEC3"}, {"count", arrays.positions.size() / 3}},
                            {{"componentType", 5125}, {"type", "SCALAR"}, {"count", arrays.indices.size()}}};
  gltf.show(gltf.addMesh(
      {{{"attributes", {{"POSITION", 0}}},
        {"indices", 1},
        {"extensions",
         {{"KHR_draco_mesh_compression",
           {{"bufferView", view}, {"attributes", {{"POSITION", mesh->attribute(attribute)->unique_id()}}}}}}}}}));
  const Mesh read = onlyMeshOf(gltf);
  EXPECT_EQ(read.elementCount(), mesh->num_faces());
  const Box3d box = boxOf(read), expected = boxOf(sphere(20, 20));
  EXPECT_LE(length(box.min - expected.min) + length(box.max - expected.max), 1e-3);
  gltf.buffer[gltf.buffer.size() / 2] ^= 0xff;
  gltf.buffer.resize(gltf.buffer.size() - 20);
  EXPECT_EQ(errorOf(gltf.text(), "a.gltf").kind(), ErrorKind::truncated);
}

TEST(Glb, IsReadLikeItsGltf) {
  GltfText gltf;
  gltf.show(gltf.addTriangle(3));
  const Bytes glb = gltf.glb();
  EXPECT_EQ(importBytes(glb, "x").format, "GLB");
  EXPECT_EQ(cornersOf(onlyMesh(glb, "x")), cornersOf(onlyMeshOf(gltf)));
  for (std::size_t length = 0; length < glb.size(); ++length)
    EXPECT_THROW(importBytes(ByteSpan(glb).first(length), "x.glb"), Error) << length;
}

TEST(GltfPrimitive, AnAttributeWithoutAnAccessorIsMalformed) {
  GltfText gltf;
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", nullptr}}}}}));
  try {
    onlyMeshOf(gltf);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::malformed);
    EXPECT_NE(std::string(error.what()).find("has no accessor for 'POSITION'"), std::string::npos) << error.what();
  }
}

} // namespace
} // namespace imgeo::testing
