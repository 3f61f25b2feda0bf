#include "import/gltf/materials.h"

#include "base/file.h"
#include "base/testing.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "import/gltf/testing.h"
#include "import/testing.h"
#include "scene/testing.h"

#include <cmath>
#include <gtest/gtest.h>

namespace imgeo::testing {
namespace {

using Json = GltfText::Json;

const std::string png = "\x89PNG\r\n\x1a\n and so on";

Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

/// A document with one triangle of this material.
GltfText withMaterial(Json material) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json["materials"] = Json::array({std::move(material)});
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  return gltf;
}

Appearance readAppearance(const GltfText& gltf, const ImportOptions& options = {}) {
  return appearanceOf(read(gltf, options).scene.graph, 0);
}

TEST(GltfMaterial, BecomesAPhysicalMaterial) {
  const Appearance appearance = readAppearance(
      withMaterial({{"name", "steel"},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {0.5, 0.25, 0, 0.75}}, {"metallicFactor", 0.5}, {"roughnessFactor", 0.25}}},
                    {"emissiveFactor", {0, 0.5, 0}},
                    {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 4}}}}},
                    {"alphaMode", "MASK"},
                    {"alphaCutoff", 0.25}}));
  EXPECT_EQ(appearance.name, "steel");
  PhysicalMaterial expected;
  expected.baseColor = {0.5f, 0.25f, 0};
  expected.metallic = 0.5f;
  expected.roughness = 0.25f;
  expected.emissiveColor = {0, 0.5f, 0};
  expected.extensions = {EmissiveStrengthMaterialExtension{4}};
  expected.transparency = 0.25f;
  EXPECT_EQ(appearance.material, AnyMaterial(expected));
  EXPECT_EQ(appearance.alphaMode, AlphaMode::mask);
  EXPECT_EQ(appearance.alphaCutoff, 0.25f);
}

TEST(GltfMaterial, HasTheExtensionsThatChangeIt) {
  const auto extensionsOf = [](const Json& json) {
    return std::get<PhysicalMaterial>(readAppearance(withMaterial({{"extensions", json}})).material).extensions;
  };
  EXPECT_EQ(
      extensionsOf({{"KHR_materials_volume",
                     {{"thicknessFactor", 0.5}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0}}}},
                    {"KHR_materials_transmission", {{"transmissionFactor", 1.5}}},
                    {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {2, 1, 0}}}},
                    {"KHR_materials_sheen", {{"sheenColorFactor", {1, 0, 0}}, {"sheenRoughnessFactor", 0.25}}},
                    {"KHR_materials_iridescence",
                     {{"iridescenceFactor", 1},
                      {"iridescenceIor", 1.8},
                      {"iridescenceThicknessMinimum", 200},
                      {"iridescenceThicknessMaximum", 300}}},
                    {"KHR_materials_ior", {{"ior", 1.25}}},
                    {"KHR_materials_dispersion", {{"dispersion", 0.5}}},
                    {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}, {"clearcoatRoughnessFactor", 0.5}}},
                    {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}, {"anisotropyRotation", -1}}}}),
      (std::vector<MaterialExtension>{
          AnisotropyMaterialExtension{0.5f, -1}, ClearcoatMaterialExtension{1, 0.5f}, DispersionMaterialExtension{0.5f},
          IORMaterialExtension{1.25f}, IridescenceMaterialExtension{1, 1.8f, 200, 300},
          SheenMaterialExtension{{1, 0, 0}, 0.25f}, SpecularMaterialExtension{0.5f, {2, 1, 0}},
          TransmissionMaterialExtension{1}, VolumeMaterialExtension{0.5f, 2, {1, 0.5f, 0}}}));
  EXPECT_EQ(extensionsOf({{"KHR_materials_clearcoat", Json::object()}, {"KHR_materials_ior", {{"ior", 1.5}}}}),
            std::vector<MaterialExtension>{});
  EXPECT_EQ(extensionsOf({{"KHR_materials_ior", {{"ior", 0}}}}),
            std::vector<MaterialExtension>{IORMaterialExtension{1000}});
}

TEST(GltfMaterial, KeepsTheTexturesOfItsExtensions) {
  const Json texture{{"index", 0}};
  GltfText gltf =
      withMaterial({{"extensions",
                     {{"KHR_materials_clearcoat", {{"clearcoatTexture", texture}, {"clearcoatNormalTexture", texture}}},
                      {"KHR_materials_transmission", {{"transmissionFactor", 1}, {"transmissionTexture", texture}}}}}});
  gltf.json["images"] = {{{"uri", GltfText::dataUrl(bytesOf(png))}}};
  gltf.json["textures"] = {{{"source", 0}}};
  const Appearance appearance = readAppearance(gltf);
  std::vector<TextureRole> roles;
  for (const TextureUse& use : appearance.textures)
    roles.push_back(use.role);
  EXPECT_EQ(roles, (std::vector{TextureRole::clearcoat, TextureRole::clearcoatNormal, TextureRole::transmission}));
  EXPECT_EQ(std::get<PhysicalMaterial>(appearance.material).extensions,
            (std::vector<MaterialExtension>{ClearcoatMaterialExtension{}, TransmissionMaterialExtension{1}}));
}

TEST(GltfMaterial, OfSpecularAndGlossinessBecomesADielectricWithItsSpecularColour) {
  Raster raster{2, 1, {10, 20, 30, 255, 40, 50, 60, 51}};
  GltfText gltf = withMaterial({{"extensions",
                                 {{"KHR_materials_pbrSpecularGlossiness",
                                   {{"diffuseFactor", {1, 0, 0, 1}},
                                    {"specularFactor", {0.5, 0.25, 1}},
                                    {"glossinessFactor", 0.5},
                                    {"specularGlossinessTexture", {{"index", 0}}}}}}}});
  gltf.json["images"] = {{{"uri", GltfText::dataUrl(encodeLosslessWebp(raster))}}};
  gltf.json["textures"] = {{{"source", 0}}};
  const SceneGraph graph = read(gltf).scene.graph;
  const Appearance& appearance = appearanceOf(graph, 0);
  PhysicalMaterial expected;
  expected.baseColor = {1, 0, 0};
  expected.metallic = 0;
  expected.extensions = {IORMaterialExtension{1000}, SpecularMaterialExtension{1, {0.5f, 0.25f, 1}}};
  EXPECT_EQ(appearance.material, AnyMaterial(expected));
  ASSERT_EQ(appearance.textures.size(), 2u);
  EXPECT_EQ(appearance.textures[0].role, TextureRole::specularColor);
  EXPECT_EQ(appearance.textures[1].role, TextureRole::metallicRoughness);
  const Raster roughness =
      decodeRaster(graph.images[graph.textures[appearance.textures[1].texture].image].bytes, "roughness");
  EXPECT_EQ(roughness.pixels, (Bytes{0, 128, 0, 255, 0, 230, 0, 255}));
}

TEST(GltfMaterial, MayBeUnlit) {
  const Appearance unlit =
      readAppearance(withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {0.214, 1, 0, 1}}}},
                                   {"extensions", {{"KHR_materials_unlit", Json::object()}}}}));
  EXPECT_NEAR(std::get<UnlitMaterial>(unlit.material).emissiveColor.x, 0.5, 1e-3);
}

TEST(GltfTexture, IsReadWithItsSamplerFromABufferOrAUrl) {
  GltfText gltf = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}},
                                {"normalTexture", {{"index", 1}, {"scale", 0.5}}}});
  gltf.json["images"] = {{{"bufferView", gltf.addView(bytesOf(png))}, {"mimeType", "image/png"}, {"name", "wood"}},
                         {{"uri", GltfText::dataUrl(bytesOf(png + "2"))}}};
  gltf.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}, {"minFilter", 9986}}};
  gltf.json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
  const SceneGraph graph = read(gltf).scene.graph;
  const Appearance& appearance = appearanceOf(graph, 0);
  ASSERT_EQ(appearance.textures.size(), 2u);
  EXPECT_EQ(appearance.textures[0].role, TextureRole::color);
  EXPECT_EQ(appearance.textures[1].role, TextureRole::normal);
  const Texture& wood = graph.textures[appearance.textures[0].texture];
  EXPECT_EQ(wood, (Texture{"wood", 0, Boundary::clamp, Boundary::mirroredRepeat, Filter::nearest, Filter::nearest,
                           Filter::linear, true}));
  EXPECT_EQ(graph.images[wood.image].bytes, bytesOf(png));
  EXPECT_EQ(graph.images[1].bytes, bytesOf(png + "2"));
  EXPECT_EQ(std::get<PhysicalMaterial>(appearance.material).normalScale, 0.5f);
}

TEST(GltfTexture, IsReadFromTheFolderOfTheFileOnly) {
  const TemporaryDirectory directory;
  std::filesystem::create_directories(directory / "scene/maps");
  writeFile(directory / "scene/maps/a b.png", bytesOf(png));
  writeFile(directory / "secret.png", bytesOf(png));
  std::filesystem::create_symlink(directory / "secret.png", directory / "scene/link.png");
  const auto imported = [&](const std::string& uri, bool outside = false) {
    GltfText gltf = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    gltf.json["images"] = {{{"uri", uri}}};
    gltf.json["textures"] = {{{"source", 0}}};
    writeFile(directory / "scene/a.gltf", asBytes(gltf.text()));
    ImportOptions options;
    options.outside = outside;
    return importFile(directory / "scene/a.gltf", options);
  };
  const Imported found = imported("maps/a%20b.png");
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_EQ(found.scene.graph.images.at(0).url, "maps/a%20b.png");
  const auto expectLeftOut = [&](const std::string& uri, const std::string& words) {
    const Imported left = imported(uri);
    EXPECT_TRUE(appearanceOf(left.scene.graph, 0).textures.empty()) << uri;
    ASSERT_EQ(left.warnings.size(), 1u) << uri;
    EXPECT_NE(left.warnings[0].find(words), std::string::npos) << left.warnings[0];
  };
  expectLeftOut("missing.png", "No such file");
  expectLeftOut("../secret.png", "outside of the folder");
  expectLeftOut("%2e%2e/secret.png", "outside of the folder");
  expectLeftOut((directory / "secret.png").string(), "outside of the folder");
  expectLeftOut("link.png", "outside of the folder");
  expectLeftOut("https://example.org/a.png", "another host");
  expectLeftOut("file:///etc/passwd", "another host");
  expectLeftOut("a.gltf", "kind that browsers do not show");
  EXPECT_TRUE(imported("../secret.png", true).warnings.empty());
}

TEST(GltfTexture, HasTheSameTransformInX3d) {
  Random random(3);
  const auto near = [](double a, double b) { return std::abs(a - b) <= 1e-5 * (1 + std::abs(a)); };
  for (int i = 0; i < 200; ++i) {
    const float rotation = random.between(-3, 3), size = random.between(0.1f, 4), x = random.between(-2, 2),
                y = random.between(-2, 2);
    const bool isRotated = random.oneIn(2);
    const Vec2f scale = isRotated ? Vec2f{size, size} : Vec2f{size, random.between(-3, -1)};
    const float angle = isRotated ? rotation : 0;
    GltfText gltf =
        withMaterial({{"pbrMetallicRoughness",
                       {{"baseColorTexture",
                         {{"index", 0},
                          {"extensions",
                           {{"KHR_texture_transform",
                             {{"offset", {x, y}}, {"scale", {scale.x, scale.y}}, {"rotation", angle}}}}}}}}}});
    gltf.json["images"] = {{{"uri", GltfText::dataUrl(bytesOf(png))}}};
    gltf.json["textures"] = {{{"source", 0}}};
    const TextureTransform transform = readAppearance(gltf).textures.at(0).transform;

    const double u = random.between(0, 1), v = random.between(0, 1); // v points down
    const double gltfU = std::cos(angle) * scale.x * u + std::sin(angle) * scale.y * v + x,
                 gltfV = -std::sin(angle) * scale.x * u + std::cos(angle) * scale.y * v + y;
    const double s = u + transform.translation.x, t = 1 - v + transform.translation.y;
    const double cosine = std::cos(transform.rotation), sine = std::sin(transform.rotation);
    EXPECT_TRUE(near((cosine * s - sine * t) * transform.scale.x, gltfU)) << i;
    EXPECT_TRUE(near((sine * s + cosine * t) * transform.scale.y, 1 - gltfV)) << i;
  }
}

} // namespace
} // namespace imgeo::testing
