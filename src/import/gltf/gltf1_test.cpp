#include "import/gltf/gltf1.h"

#include "base/bytes.h"
#include "base/soak_testing.h"
#include "import/references.h"
#include "import/testing.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;

/// A GLB file of version 1 with this JSON and buffer.
Bytes glb1(const Json& json, const Bytes& body, std::uint32_t tooLong = 0) {
  const std::string text = json.dump();
  Bytes bytes;
  for (const std::uint32_t word : {0x46546c67u, 1u, static_cast<std::uint32_t>(20 + text.size() + body.size()),
                                   static_cast<std::uint32_t>(text.size()) + tooLong, 0u})
    appendLittle(bytes, word);
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.insert(bytes.end(), body.begin(), body.end());
  return bytes;
}

/// One triangle, and an image and a shader in buffer views.
Json triangleJson() {
  return Json::parse(R"({"asset":{"version":"1.0"},"extensionsUsed":["KHR_binary_glTF"],
    "buffers":{"binary_glTF":{"type":"arraybuffer","byteLength":44,"uri":"data:,"}},
    "bufferViews":{"v":{"buffer":"binary_glTF","byteOffset":0,"byteLength":36,"target":34962},
                   "i":{"buffer":"binary_glTF","byteOffset":36,"byteLength":6,"target":34963},
                   "p":{"buffer":"binary_glTF","byteOffset":42,"byteLength":2}},
    "accessors":{"a":{"bufferView":"v","byteOffset":0,"componentType":5126,"count":3,"type":"VEC3"},
                 "b":{"bufferView":"i","byteOffset":0,"componentType":5123,"count":3,"type":"SCALAR"}},
    "images":{"m":{"uri":"data:,","extensions":{"KHR_binary_glTF":{"bufferView":"p","mimeType":"image/png"}}}},
    "meshes":{"mesh":{"primitives":[{"attributes":{"POSITION":"a"},"indices":"b","mode":4}]}},
    "nodes":{"n":{"meshes":["mesh"]}},"scenes":{"s":{"nodes":["n"]}},"scene":"s"})");
}

Bytes triangleBody() {
  Bytes body;
  for (const float value : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 3.f, 0.f})
    appendLittle(body, value);
  for (std::uint16_t index = 0; index < 3; ++index)
    appendLittle(body, index);
  body.push_back('P');
  body.push_back('!');
  return body;
}

TEST(Gltf1, OfABinaryFileIsReadWithItsBuffer) {
  const Imported imported = importBytes(glb1(triangleJson(), triangleBody()), "old.glb", {});
  ASSERT_EQ(imported.scene.meshes.size(), 1u);
  const Mesh& mesh = imported.scene.meshes[0];
  EXPECT_EQ(mesh.elementCount(), 1u);
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}));
}

TEST(Gltf1, AnimationsAreNotReadAndAWarningSaysSo) {
  Json json = triangleJson();
  json["animations"] = {{"walk", {{"channels", Json::array()}, {"samplers", Json::object()}}}};
  EXPECT_EQ(importBytes(glb1(json, triangleBody()), "old.glb", {}).warnings,
            std::vector<std::string>{"1 animation is not carried over: those of glTF 1.0 are not read."});
}

TEST(Gltf1, OfABinaryFileHasItsBufferAndImagesAsDataUrls) {
  const Json json = Json::parse(jsonOfGlb1(glb1(triangleJson(), triangleBody()), "old.glb"));
  const Bytes body = triangleBody();
  EXPECT_EQ(json["buffers"]["binary_glTF"]["uri"], dataUrlOf(body, "application/octet-stream"));
  EXPECT_EQ(json["images"]["m"]["uri"], "data:image/png;base64,UCE=");
}

SOAK_TEST(Gltf1, OfABinaryFileWhoseImagesRepeatItsBufferTooOftenIsRefused) {
  Json json = triangleJson();
  const Json image = json["images"]["m"];
  json["bufferViews"]["p"]["byteLength"] = 1 << 20;
  for (int i = 0; i < 300; ++i)
    json["images"]["m" + std::to_string(i)] = image;
  Bytes body = triangleBody();
  body.resize(42 + (1 << 20));
  try {
    jsonOfGlb1(glb1(json, body), "old.glb");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::limit);
  }
}

TEST(Gltf1, OfADamagedBinaryFileIsRefused) {
  const auto refusalOf = [](const Bytes& bytes) {
    try {
      jsonOfGlb1(bytes, "old.glb");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const Bytes whole = glb1(triangleJson(), triangleBody());
  EXPECT_NE(refusalOf(Bytes(whole.begin(), whole.begin() + 19)).find("at least 20 bytes"), std::string::npos);
  EXPECT_NE(refusalOf(Bytes(whole.begin(), whole.end() - 1)).find("but its header says"), std::string::npos);
  EXPECT_NE(refusalOf(glb1(triangleJson(), triangleBody(), 1000)).find("longer than what is left"), std::string::npos);
  Json json = triangleJson();
  json["bufferViews"]["p"]["byteLength"] = 3;
  EXPECT_NE(refusalOf(glb1(json, triangleBody())).find("bufferViews.p: reaches beyond"), std::string::npos);
  json["images"]["m"]["extensions"]["KHR_binary_glTF"]["bufferView"] = "none";
  EXPECT_NE(refusalOf(glb1(json, triangleBody())).find("names no buffer view"), std::string::npos);
  json["images"] = {{"m", 3}};
  EXPECT_NE(refusalOf(glb1(json, triangleBody())).find("is no object"), std::string::npos);
  json.erase("images");
  json["buffers"] = {{"binary_glTF", 3}};
  EXPECT_EQ(refusalOf(glb1(json, triangleBody())), "");
}

} // namespace
} // namespace imgeo
