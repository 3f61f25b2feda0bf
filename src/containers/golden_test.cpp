// Files of version 1 of the classic and BG formats, which all later readers must read. IMGEO_REWRITE_GOLDEN=1 writes
// them again; files that change need a new version of the format and a new name.
#include "base/file.h"
#include "containers/normals.h"
#include "containers/png/png.h"
#include "containers/stored.h"
#include "containers/testing.h"
#include "containers/unit_vectors.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

const std::filesystem::path golden = IMGEO_GOLDEN;

/// A small torus with normals, texture coordinates and colours that vary in all channels.
PatchedMesh goldenMesh() {
  Mesh mesh = testing::torus(5, 4);
  mesh.colorComponents = 4;
  for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
    const auto byte = [&](std::size_t factor) { return static_cast<std::uint8_t>(wedge * factor); };
    mesh.colors.push_back(Rgba8{byte(8), byte(5), byte(3), byte(7)});
  }
  return testing::onePatch(mesh, 12);
}

struct GoldenPatch {
  IndexedPatch source;
  GeometryDescription geometry;
  EncodedPatch encoded;
};

/// Options to encode the mesh with; `name` begins the names of its files.
struct Variant {
  const char* name;
  EncodeOptions options;
};

const Variant variants[] = {
    {"sig-classic-1", {Encoding::classic, 8, 9}},
    {"sig-classic-1-octahedral", {Encoding::classic, 8, 9, Target::web, NormalEncoding::octahedral}},
    {"sig-classic-1-spherical", {Encoding::classic, 8, 9, Target::web, NormalEncoding::spherical}},
    {"sig-classic-1-palette", {Encoding::classic, 8, 9, Target::web, NormalEncoding::palette}},
    {"sig-classic-1-rgb-16", {.encoding = Encoding::classic, .normalBits = 16, .effort = 9, .texCoordBits = 8}},
    {"sig-classic-1-octahedral-16",
     {.encoding = Encoding::classic, .normalBits = 16, .effort = 9, .normals = NormalEncoding::octahedral}},
    {"sig-classic-1-spherical-16",
     {.encoding = Encoding::classic,
      .normalBits = 16,
      .effort = 9,
      .normals = NormalEncoding::spherical,
      .texCoordBits = 24,
      .colorBits = 16}},
    {"sig-classic-1-color-24", {.encoding = Encoding::classic, .effort = 9, .colorBits = 24}},
    {"bg-1", {Encoding::bg, 8, 9}},
    {"bg-1-octahedral", {Encoding::bg, 16, 9, Target::web, NormalEncoding::octahedral}},
    {"bg-1-spherical", {Encoding::bg, 8, 9, Target::web, NormalEncoding::spherical}},
    {"bg-1-spherical-16",
     {.encoding = Encoding::bg,
      .normalBits = 16,
      .effort = 9,
      .normals = NormalEncoding::spherical,
      .texCoordBits = 8,
      .colorBits = 16}},
    {"bg-1-floats", {.encoding = Encoding::bg, .normalBits = 32, .effort = 9, .texCoordBits = 32, .colorBits = 32}},
};

GoldenPatch encodeGolden(const EncodeOptions& options) {
  const PatchedMesh mesh = goldenMesh();
  GoldenPatch patch{testing::verticesOf(mesh.patches[0], Primitive::triangles, true), describe(mesh, options), {}};
  patch.encoded = encodePatch(patch.source, patch.geometry, options);
  return patch;
}

std::filesystem::path pathOf(const Variant& variant, std::size_t number, const EncodedFile& file) {
  return golden / (std::string(variant.name) + "-" + std::to_string(number) + "-" + nameOf(file.role) + file.extension);
}

class Golden : public ::testing::TestWithParam<Variant> {
protected:
  static void SetUpTestSuite() {
    if (std::getenv("IMGEO_REWRITE_GOLDEN") == nullptr)
      return;
    for (const Variant& variant : variants) {
      const GoldenPatch patch = encodeGolden(variant.options);
      for (std::size_t i = 0; i < patch.encoded.files.size(); ++i)
        writeFile(pathOf(variant, i, patch.encoded.files[i]), patch.encoded.files[i].bytes);
    }
  }
};

TEST_P(Golden, FilesAreStillRead) {
  GoldenPatch patch = encodeGolden(GetParam().options);
  for (std::size_t i = 0; i < patch.encoded.files.size(); ++i)
    patch.encoded.files[i].bytes = readFile(pathOf(GetParam(), i, patch.encoded.files[i]));
  const IndexedPatch decoded = decodePatch(patch.encoded, patch.geometry);
  EXPECT_EQ(decoded.positions, patch.source.positions);
  EXPECT_EQ(decoded.colors, patch.source.colors);
  EXPECT_EQ(decoded.indices, patch.source.indices);
  const double bound = std::max(normalErrorBound(patch.geometry), patch.encoded.normalError + 1e-6);
  for (std::size_t i = 0; i < decoded.normals.size(); ++i)
    EXPECT_LE(angleBetween(decoded.normals[i], patch.source.normals[i]), bound);
  for (std::size_t i = 0; i < decoded.texCoords.size(); ++i)
    EXPECT_NEAR(decoded.texCoords[i].x, patch.source.texCoords[i].x,
                texCoordErrorBound(patch.geometry, 0, patch.geometry.imageBits[VertexRole::texCoord]).x);
}

TEST_P(Golden, FilesAreStillWritten) {
  const GoldenPatch patch = encodeGolden(GetParam().options);
  for (std::size_t i = 0; i < patch.encoded.files.size(); ++i) {
    const std::filesystem::path path = pathOf(GetParam(), i, patch.encoded.files[i]);
    const Bytes &now = patch.encoded.files[i].bytes, before = readFile(path);
    // Another version of libdeflate may compress differently, so PNGs are compared by their pixels.
    if (path.extension() == ".png")
      EXPECT_EQ(decodePng(now, "now"), decodePng(before, "before")) << path;
    else
      EXPECT_EQ(now, before) << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Golden, ::testing::ValuesIn(variants), [](const auto& parameter) {
  std::string name = parameter.param.name;
  std::erase(name, '-');
  return name;
});

} // namespace
} // namespace imgeo
