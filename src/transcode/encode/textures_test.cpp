#include "transcode/encode/textures.h"

#include "base/error.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/image_type.h"
#include "images/testing.h"
#include "transcode/site/site_files.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

namespace fs = std::filesystem;

/// A scene of one shape that uses images in these roles.
class Textures : public ::testing::Test {
protected:
  void use(TextureRole role, Bytes image, const std::string& url = "some image") {
    graph.images.push_back({url, std::move(image)});
    graph.textures.emplace_back().image = graph.images.size() - 1;
    graph.appearances.at(0).textures.push_back({role, graph.textures.size() - 1, {}});
  }
  void SetUp() override {
    graph.appearances.emplace_back();
    Shape shape;
    shape.appearance = 0;
    addRoot(graph, {"", shape, {}, ""});
  }
  TextureReport write() {
    ContentFiles files(directory.path(), textureFolder);
    return writeTextures(graph, options, files, warnings);
  }
  Bytes written(std::size_t image) const { return readFile(directory.path() / graph.images.at(image).url); }
  Raster raster(std::size_t image) const { return decodeRaster(written(image), "written"); }

  TemporaryDirectory directory;
  SceneGraph graph;
  ConvertOptions options;
  std::vector<std::string> warnings;
};

Bytes pictureBytes(std::uint32_t edge) {
  return encodeLosslessWebp(testRaster(edge, edge));
}

TEST_F(Textures, AreKeptUnchangedIfBrowsersDisplayThem) {
  const Bytes image = pictureBytes(16);
  use(TextureRole::color, image);
  const TextureReport report = write();
  EXPECT_EQ(written(0), image);
  EXPECT_EQ(report.reencoded + report.resized + report.previews, 0u);
  EXPECT_EQ(report.bytes, report.sourceBytes);
}

TEST_F(Textures, InFormatsThatBrowsersDoNotDisplayAreReencodedWithoutLoss) {
  use(TextureRole::color, tgaOf(testRaster(24, 8, true)));
  EXPECT_EQ(write().reencoded, 1u);
  EXPECT_EQ(imageType(written(0)), ".webp");
  EXPECT_EQ(raster(0), testRaster(24, 8, true));
}

TEST_F(Textures, ThatCannotBeDecodedAreLeftOutWithAWarning) {
  Bytes cut = tgaOf(testRaster(24, 8));
  cut.resize(100);
  use(TextureRole::color, cut, "cut.tga");
  use(TextureRole::normal, tgaOf(testRaster(8, 8)));
  EXPECT_EQ(write().files, 1u);
  ASSERT_EQ(graph.appearances[0].textures.size(), 1u);
  EXPECT_EQ(graph.appearances[0].textures[0].role, TextureRole::normal);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("cut.tga"), std::string::npos);

  use(TextureRole::emissive, cut, "cut.tga");
  options.strict = true;
  EXPECT_THROW(write(), Error);
}

TEST_F(Textures, AreShrunkAndNeverEnlarged) {
  use(TextureRole::color, tgaOf(testRaster(64, 16)));
  use(TextureRole::emissive, pictureBytes(20));
  options.textures.size = 32;
  EXPECT_EQ(write().resized, 1u);
  EXPECT_EQ(raster(0).width, 32u);
  EXPECT_EQ(raster(0).height, 8u);
  EXPECT_EQ(raster(1).width, 20u);
}

TEST_F(Textures, AreLossyOnlyIfTheyAreColours) {
  const Raster noise = testRaster(64, 64);
  use(TextureRole::color, tgaOf(noise));
  use(TextureRole::normal, tgaOf(noise));
  graph.images[1].bytes.push_back(0); // another file
  for (const TextureFormat format : {TextureFormat::webp, TextureFormat::png}) {
    const SceneGraph before = graph;
    options.textures.format = format;
    write();
    EXPECT_EQ(raster(0) == noise, format == TextureFormat::png);
    EXPECT_EQ(raster(1), noise);
    graph = before;
  }
  options.textures.format = TextureFormat::avif;
  write();
  EXPECT_EQ(imageType(written(0)), ".avif");
  EXPECT_EQ(raster(1), noise);
}

TEST_F(Textures, StayUnchangedIfAnotherFormatTakesMoreBytes) {
  const Bytes webp = encodeWebp(testRaster(64, 64), 5);
  use(TextureRole::color, webp);
  options.textures.format = TextureFormat::png;
  EXPECT_EQ(write().reencoded, 0u);
  EXPECT_EQ(written(0), webp);
}

TEST_F(Textures, HaveAPreviewIfTheyAreLargeColourImages) {
  const Bytes large = tgaOf(noiseRaster(256, 128));
  use(TextureRole::color, large);
  use(TextureRole::metallicRoughness, large);
  graph.images[1].bytes.push_back(0);
  use(TextureRole::emissive, tgaOf(testRaster(100, 10)));
  options.textures.format = TextureFormat::png;
  const TextureReport report = write();
  EXPECT_EQ(report.previews, 1u);
  const Bytes preview = readFile(directory.path() / graph.images[0].preview);
  EXPECT_EQ(report.previewBytes, preview.size());
  EXPECT_LT(preview.size(), 3000u);
  const Raster small = decodeRaster(preview, "preview");
  EXPECT_EQ(std::pair(small.width, small.height), std::pair(64u, 32u));
  EXPECT_EQ(graph.images[1].preview + graph.images[2].preview, "");
}

TEST_F(Textures, OfX3dSourcesHaveTheRoleOfTheirField) {
  graph.images.push_back({"n.tga", tgaOf(testRaster(8, 8))});
  addRoot(graph, {"", GenericNode{"ImageTexture", "", {{"url", 0}}}, {}, "", {{"containerField", "normalTexture"}}});
  const ImageUse use = imageUses(graph).at(0);
  EXPECT_TRUE(use.isUsed && use.isData && use.isNormal && !use.isColor);
}

TEST(TexturedSite, ListsItsTexturesAndTheirPreviews) {
  const TemporaryDirectory directory;
  writeFile(directory.path() / "plane.obj", asBytes("mtllib plane.mtl\nusemtl wood\nv 0 0 0\nv 1 0 0\nv 0 1 "
                                                    "0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"));
  writeFile(directory.path() / "plane.mtl", asBytes("newmtl wood\nmap_Kd wood.tga\n"));
  const Bytes wood = tgaOf(noiseRaster(256, 256));
  writeFile(directory.path() / "wood.tga", wood);
  ConvertOptions options;
  options.textures.format = TextureFormat::png;
  const ConvertReport report = convert(directory.path() / "plane.obj", directory.path() / "site", options);
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  const SiteInfo info = inspect(directory.path() / "site");
  EXPECT_EQ(info.sourceTextureBytes, wood.size());
  EXPECT_EQ(info.textureBytes, report.textures.bytes + report.textures.previewBytes);
  std::size_t previews = 0;
  for (const SiteFile& file : info.files)
    previews += file.role == "preview";
  EXPECT_EQ(previews, 1u);
  EXPECT_TRUE(verify(directory.path() / "site", directory.path() / "plane.obj").equal);
}

} // namespace
} // namespace imgeo::testing
