#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "import/gltf/testing.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::GltfText;
using testing::TemporaryDirectory;

// 1 x 1 pixel.
const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x8\2\0\0\0\x90wS\xde\0\0\0\fIDATx\x9c"
                      "c\xf8\xff\xff?\0\5\xfe\2\xfe\r\xef"
                      "F\xb8\0\0\0\0IEND\xae"
                      "B`\x82",
                      69);

/// A grid with an albedo on set 0 and a light map on set 1, which has a seam in the middle and a transform of its own.
GltfText bakedGrid(int cells) {
  std::vector<float> positions, albedo, lightMap;
  std::vector<std::uint32_t> indices;
  for (const int half : {0, 1}) {
    const auto first = static_cast<std::uint32_t>(positions.size() / 3),
               columns = static_cast<std::uint32_t>(cells / 2);
    for (int y = 0; y <= cells; ++y)
      for (std::uint32_t i = 0; i <= columns; ++i) {
        const auto x = static_cast<float>(half * cells / 2 + static_cast<int>(i)), v = static_cast<float>(y);
        const float n = static_cast<float>(cells);
        positions.insert(positions.end(), {x, v, std::sin(x) * std::cos(v)});
        albedo.insert(albedo.end(), {30 * x / n, 30 * v / n});
        lightMap.insert(lightMap.end(), {half == 0 ? x / n : 1 - 0.9f * v / n, half == 0 ? v / n : x / n});
      }
    for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(cells); ++y)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const std::uint32_t a = first + y * (columns + 1) + i, b = a + columns + 1;
        indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
      }
  }
  GltfText gltf;
  const std::size_t p = gltf.addAccessor(positions, "VEC3", 5126), t0 = gltf.addAccessor(albedo, "VEC2", 5126),
                    t1 = gltf.addAccessor(lightMap, "VEC2", 5126), i = gltf.addAccessor(indices, "SCALAR", 5125);
  gltf.show(gltf.addMesh(
      {{{"attributes", {{"POSITION", p}, {"TEXCOORD_0", t0}, {"TEXCOORD_1", t1}}}, {"indices", i}, {"material", 0}}}));
  gltf.json["images"] = {{{"uri", GltfText::dataUrl({png.begin(), png.end()})}}};
  gltf.json["textures"] = {{{"source", 0}}};
  gltf.json["materials"] = {
      {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
       {"emissiveTexture",
        {{"index", 0}, {"texCoord", 1}, {"extensions", {{"KHR_texture_transform", {{"scale", {0.5, 0.5}}}}}}}},
       {"emissiveFactor", {1, 1, 1}}}};
  return gltf;
}

void expectEqual(const std::filesystem::path& site, const std::filesystem::path& input) {
  const VerifyReport verified = verify(site, input);
  EXPECT_TRUE(verified.equal) << fmt::format("{}", fmt::join(verified.findings, " "));
}

TEST(TextureCoordinates, OfTwoSetsAreKeptInEveryEncodingAndExported) {
  const TemporaryDirectory directory;
  const auto path = [&](const char* name) { return directory.path() / name; };
  writeFile(path("room.gltf"), asBytes(bakedGrid(40).text()));
  for (const Encoding encoding : {Encoding::compact, Encoding::classic, Encoding::bg}) {
    SCOPED_TRACE(nameOf(encoding));
    ConvertOptions options;
    options.encoding = encoding;
    options.effort = 0;
    options.patchVertices = 300;
    options.force = true;
    convert(path("room.gltf"), path("site"), options);
    expectEqual(path("site"), path("room.gltf"));
    EXPECT_EQ(inspect(path("site")).geometries.at(0).texCoordSets, 2u);
    const SiteMesh mesh = readSiteMeshes(path("site")).meshes.at(0);
    ASSERT_EQ(mesh.furtherTexCoords.size(), 1u);
    EXPECT_EQ(mesh.furtherTexCoords[0].size(), mesh.positions.size());

    exportSite(path("site"), path("out.glb"));
    expectEqual(path("site"), path("out.glb"));
    const Imported exported = importFile(path("out.glb"));
    const Mesh& again = exported.scene.meshes.at(0);
    EXPECT_EQ(texCoordSetCount(again), 2u);
    const Appearance& appearance = exported.scene.graph.appearances.at(0);
    ASSERT_EQ(appearance.textures.size(), 2u);
    EXPECT_EQ(texCoordSetNamed(appearance.textures[1].mapping, again), 1u);
    EXPECT_EQ(appearance.textures[1].transform.scale, (Vec2f{0.5f, 0.5f}));
  }
}

TEST(TextureCoordinates, OfFurtherSetsAreLeftOutForX3dom) {
  const TemporaryDirectory directory;
  const auto path = [&](const char* name) { return directory.path() / name; };
  writeFile(path("room.gltf"), asBytes(bakedGrid(8).text()));
  ConvertOptions options;
  options.encoding = Encoding::bg;
  options.target = Target::x3dom;
  const ConvertReport report = convert(path("room.gltf"), path("site"), options);
  EXPECT_TRUE(std::ranges::any_of(report.warnings, [](const std::string& warning) {
    return warning.starts_with("X3DOM reads one set of texture coordinates: the others of 1 mesh");
  })) << fmt::format("{}", fmt::join(report.warnings, " "));
  EXPECT_EQ(inspect(path("site")).geometries.at(0).texCoordSets, 1u);
  expectEqual(path("site"), path("room.gltf"));
}

} // namespace
} // namespace imgeo
