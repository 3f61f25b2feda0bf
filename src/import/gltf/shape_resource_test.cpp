#include "import/gltf/shape_resource.h"

#include "base/error.h"
#include "import/gltf/resource_testing.h"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace imgeo::gltf {
namespace {

using Json = nlohmann::ordered_json;

using namespace imgeo::testing;

std::vector<Vec3f> cornersOf(const Mesh& mesh) {
  std::vector<Vec3f> corners;
  for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner)
    corners.push_back(mesh.cornerPosition(corner));
  return corners;
}

/// The shape of a kind of element.
const ResourceShape& shapeWith(Topology topology, const ShapeResource& resource) {
  const auto found =
      std::ranges::find(resource.shapes, topology, [](const auto& shape) { return shape.mesh.topology; });
  EXPECT_NE(found, resource.shapes.end());
  return *found;
}

void expectSquare(const Mesh& mesh, bool isUpsideDown) {
  ASSERT_TRUE(isConsistent(mesh));
  EXPECT_EQ(cornersOf(mesh), (std::vector<Vec3f>{{0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 0, 1}, {2, 2, 1}, {0, 2, 1}}));
  const auto at = [&](std::size_t corner) { return mesh.corners[corner]; };
  EXPECT_EQ(mesh.normals[at(1)], (Vec3f{0, 0, 1}));
  EXPECT_EQ(mesh.texCoords[at(1)], (Vec2f{1, isUpsideDown ? 1.f : 0.f}));
  EXPECT_EQ(asRgba8(mesh.colors[at(0)]), (Rgba8{255, 0, 0, 255}));
  EXPECT_EQ(asRgba8(mesh.colors[at(5)]), (Rgba8{255, 255, 255, 128}));
  EXPECT_EQ(mesh.colorComponents, 4u);
  EXPECT_TRUE(mesh.namedAttributes.empty());
}

TEST(ShapeResource, IsReadInBothLayouts) {
  for (const Bytes& file : {srcFile(squareSrc(), squareBody()), glbFile(squareGltf(), squareBody())}) {
    const ShapeResource resource = readShapeResource(file, "a.src", "", false);
    ASSERT_EQ(resource.shapes.size(), 2u);
    EXPECT_TRUE(resource.materials.empty());
    expectSquare(shapeWith(Topology::triangles, resource).mesh, false);
    EXPECT_EQ(cornersOf(shapeWith(Topology::lines, resource).mesh), (std::vector<Vec3f>{{0, 0, 1}, {2, 2, 1}}));
  }
}

TEST(ShapeResource, HasTheMeshThatAUrlNames) {
  for (const Bytes& file : {srcFile(squareSrc(), squareBody()), glbFile(squareGltf(), squareBody())}) {
    const ShapeResource resource = readShapeResource(file, "a.src", "diagonal", false);
    ASSERT_EQ(resource.shapes.size(), 1u);
    EXPECT_EQ(resource.shapes[0].mesh.topology, Topology::lines);
  }
}

TEST(ShapeResource, HasMaterialsAndTheirImages) {
  Json json = squareGltf();
  const Bytes file = glbFile(json, squareBody());
  const ShapeResource resource = readShapeResource(file, "a.glb", "", true);
  ASSERT_EQ(resource.shapes.size(), 2u);
  const ResourceShape &square = shapeWith(Topology::triangles, resource), &line = shapeWith(Topology::lines, resource);
  expectSquare(square.mesh, true);
  ASSERT_TRUE(square.material && line.material);
  const ResourceMaterial &red = resource.materials[*square.material], &glow = resource.materials[*line.material];
  EXPECT_EQ(red.name, "red");
  EXPECT_EQ(red.material.diffuseColor, (Vec3f{1, 0.25f, 0}));
  EXPECT_EQ(red.material.specularColor, (Vec3f{0.5f, 0.5f, 0.5f}));
  EXPECT_EQ(red.material.shininess, 0.5f);
  EXPECT_EQ(red.material.transparency, 0.25f);
  EXPECT_FALSE(red.isSolid);
  EXPECT_EQ(glow.material.emissiveColor, (Vec3f{0, 1, 0}));
  EXPECT_EQ(glow.material.diffuseColor, (Vec3f{0, 0, 0}));

  Json& values = json["materials"]["red"]["extensions"]["KHR_materials_common"]["values"];
  values["diffuse"] = "texture";
  json["textures"] = {{"texture", {{"source", "image"}}}};
  json["images"] = {{"image", {{"extensions", {{"KHR_binary_glTF", {{"bufferView", "colors"}}}}}}}};
  const ShapeResource textured = readShapeResource(glbFile(json, squareBody()), "a.glb", "square", true);
  EXPECT_EQ(textured.materials.at(0).images.at(TextureRole::color).size(), 16u);
  EXPECT_EQ(textured.materials.at(0).material.diffuseColor, (Vec3f{1, 1, 1}));
}

TEST(ShapeResource, IsDrawnInOrderWithoutIndicesAndAsStrips) {
  Json json = squareGltf();
  Json& primitive = json["meshes"]["square"]["primitives"][0];
  primitive["indices"] = "";
  primitive["mode"] = 6;
  const ShapeResource resource = readShapeResource(glbFile(json, squareBody()), "a.glb", "square", false);
  EXPECT_EQ(resource.shapes.at(0).mesh.elementCount(), 2u);
  EXPECT_EQ(resource.shapes.at(0).mesh.positions.size(), 4u);
}

TEST(ShapeResource, ThatLiesIsRefusedWithASentence) {
  struct Lie {
    ErrorKind kind;
    std::string message;
    std::function<void(Json&)> change;
  };
  const auto expectRefusal = [](const Bytes& file, ErrorKind kind, const std::string& message) {
    try {
      readShapeResource(file, "a.src", "", true);
      ADD_FAILURE() << "read in spite of: " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), kind) << error.what();
      EXPECT_TRUE(error.location().starts_with("a.src")) << error.what();
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  };
  using enum ErrorKind;
  for (const auto& [kind, message, change] : std::initializer_list<Lie>{
           {truncated, "needs 90000 bytes", [](Json& j) { j["bufferChunks"]["c1"]["byteLength"] = 90000; }},
           {truncated, "needs 4294967295 bytes",
            [](Json& j) { j["bufferChunks"]["indices"]["byteLength"] = 4294967295; }},
           {limit, "joins more bytes",
            [](Json& j) {
              j["bufferViews"]["vertices"]["chunks"] = {"c0", "c1", "c0", "c1", "c0"};
            }},
           {truncated, "needs", [](Json& j) { j["accessors"]["attributeViews"]["positions"]["count"] = 5; }},
           {truncated, "is behind", [](Json& j) { j["accessors"]["indexViews"]["line"]["byteOffset"] = 17; }},
           {malformed, "no accessor", [](Json& j) { j["meshes"]["square"]["attributes"]["normal"] = ""; }},
           {malformed, "has no \"none\"", [](Json& j) { j["meshes"]["square"]["indices"] = "none"; }},
           {malformed, "vertex", [](Json& j) { j["accessors"]["attributeViews"]["positions"]["count"] = 2; }},
           {unsupported, "decodeScale",
            [](Json& j) {
              j["accessors"]["attributeViews"]["positions"]["decodeScale"] = {2, 2, 2};
            }},
           {malformed, "no object",
            [](Json& j) {
              j["meshes"] = {1, 2};
            }},
       }) {
    Json json = squareSrc();
    change(json);
    if (message == "no accessor" || message == "no object" || message == "vertex") {
      EXPECT_THROW(readShapeResource(srcFile(json, squareBody()), "a.src", "", true), Error) << message;
      continue;
    }
    expectRefusal(srcFile(json, squareBody()), kind, message);
  }
  const Bytes src = srcFile(squareSrc(), squareBody()), glb = glbFile(squareGltf(), squareBody());
  expectRefusal(Bytes(src.begin(), src.begin() + 11), truncated, "at least 12 bytes");
  expectRefusal(Bytes(src.begin(), src.begin() + 300), truncated, "where 288 follow");
  expectRefusal(Bytes(glb.begin(), glb.end() - 1), truncated, "but its header says");
  expectRefusal(Bytes(12, 0), malformed, "header of 0 bytes");
  Bytes damaged = src;
  damaged[12] = 'x';
  expectRefusal(damaged, malformed, "not well-formed");
  damaged = glb;
  damaged[4] = 2;
  expectRefusal(damaged, unsupported, "is glTF 2, which an Inline can name");
  damaged = glb;
  damaged[12] = damaged[13] = 255;
  expectRefusal(damaged, truncated, "has a header of");
  for (std::size_t size = 0; size < glb.size(); ++size)
    EXPECT_THROW(readShapeResource(ByteSpan(glb).first(size), "a.src", "", true), Error) << size;
  Json json = squareGltf();
  json["accessors"]["positions"]["extensions"] = {{"WEB3D_quantized_attributes", Json::object()}};
  expectRefusal(glbFile(json, squareBody()), unsupported, "WEB3D_quantized_attributes");
}

} // namespace
} // namespace imgeo::gltf
