// Checks vectors/classic-1/attributes.json: values of every attribute in every encoding and precision, and the texels
// that hold them. web/src/decode/classic/attributeVectors.test.ts decodes the same texels.
// IMGEO_REWRITE_GOLDEN=1 writes the file again.
#include "base/file.h"
#include "containers/classic/attribute_images.h"
#include "containers/testing.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace imgeo {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint32_t recordCount = 6;

/// Values with the ends of every range, a texel each.
IndexedPatch patchOfVectors(std::uint32_t colorComponents) {
  testing::Random random(16);
  IndexedPatch patch;
  patch.positions.resize(recordCount);
  patch.normals = {{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, random.direction(), random.direction(), random.direction()};
  for (std::uint32_t n = 0; n < recordCount; ++n) {
    patch.texCoords.push_back({random.between(-1, 3), random.between(-1, 3)});
    patch.colors.push_back(random.color());
  }
  patch.texCoords[0] = {-1, 3};
  patch.texCoords[1] = {3, -1};
  patch.colors[0] = Rgba8{0, 255, 1, 255};
  patch.colorComponents = colorComponents;
  return patch;
}

/// The first texels of an image, channel by channel.
Json texelsOf(const Image& image) {
  Json texels = Json::array();
  for (std::size_t i = 0; i < std::size_t{recordCount} * image.channels; ++i)
    texels.push_back(image.pixels[i]);
  return {{"channels", image.channels}, {"texels", texels}};
}

Json caseOf(VertexRole role, NormalEncoding normals, std::uint32_t bits, std::uint32_t colorComponents) {
  const IndexedPatch patch = patchOfVectors(colorComponents);
  GeometryDescription geometry;
  geometry.normalEncoding = normals;
  geometry.imageBits[role] = bits;
  geometry.colorComponents = colorComponents;
  geometry.texCoordBoxes[0] = {{-1, -1}, {4, 4}};
  Json values = Json::array();
  for (std::uint32_t n = 0; n < recordCount; ++n)
    if (role == VertexRole::normal)
      values.push_back({patch.normals[n].x, patch.normals[n].y, patch.normals[n].z});
    else if (role == VertexRole::texCoord)
      values.push_back({patch.texCoords[n].x, patch.texCoords[n].y});
    else {
      const Rgba8 color = asRgba8(patch.colors[n]);
      values.push_back({color.r / 255.0, color.g / 255.0, color.b / 255.0});
    }
  Json images = Json::array();
  for (const Image& image : attributeImages(role, patch, geometry, {recordCount, 1}))
    images.push_back(texelsOf(image));
  return {{"role", nameOf(role)}, {"normals", nameOf(normals)},
          {"bits", bits},         {"colorComponents", colorComponents},
          {"values", values},     {"images", images}};
}

Json allCases() {
  Json cases = Json::array();
  for (const NormalEncoding normals : {NormalEncoding::rgb, NormalEncoding::octahedral, NormalEncoding::spherical})
    for (const std::uint32_t bits : {8u, 16u})
      if (normals == NormalEncoding::rgb || bits == 16) // pairs of 8 bits are halves of an image
        cases.push_back(caseOf(VertexRole::normal, normals, bits, 3));
  for (const std::uint32_t bits : {8u, 16u, 24u}) {
    cases.push_back(caseOf(VertexRole::texCoord, NormalEncoding::rgb, bits, 3));
    for (const std::uint32_t components : {3u, 4u})
      cases.push_back(caseOf(VertexRole::color, NormalEncoding::rgb, bits, components));
  }
  return cases;
}

TEST(AttributeVectors, AreTheTexelsThatTheRuntimeDecodes) {
  const std::filesystem::path path = IMGEO_VECTORS "/classic-1/attributes.json";
  const Json now = allCases();
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr) {
    std::string lines;
    for (const Json& one : now)
      lines += (lines.empty() ? "[\n" : ",\n") + one.dump();
    writeFile(path, asBytes(lines + "\n]\n"));
  }
  EXPECT_EQ(now.dump(), Json::parse(asText(readFile(path))).dump());
}

} // namespace
} // namespace imgeo
