#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/imgeo.h"
#include "scene/testing.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

void writeMesh(const Mesh& mesh, const std::filesystem::path& file) {
  writeFile(file, exportScene(testing::sceneOf({mesh}), MeshFormat::ply));
}

ConvertOptions optionsFor(Encoding encoding) {
  ConvertOptions options;
  options.target = Target::x3dom;
  options.encoding = encoding;
  options.effort = 0;
  return options;
}

TEST(X3domSite, EqualsItsSourceForEveryMesh) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const TemporaryDirectory directory;
    Mesh mesh = testing::randomMesh(seed);
    ConvertOptions options = optionsFor(seed % 2 == 0 ? Encoding::classic : Encoding::bg);
    if (options.encoding == Encoding::classic)
      for (Vec2f& texCoord : mesh.texCoords)
        texCoord.x = std::clamp(texCoord.x, 0.0f, 1.0f);
    options.primitives = seed % 3 == 0 ? Primitives::strips : Primitives::triangles;
    options.positionBits = 8 + seed % 9;
    options.patchVertices = 256;
    if (options.encoding == Encoding::classic)
      options.normals = seed % 3 == 0 ? NormalEncoding::palette : NormalEncoding::rgb;
    else if (options.positionBits > 8)
      options.normals = seed % 3 == 0 ? NormalEncoding::spherical : NormalEncoding::rgb;
    writeMesh(mesh, directory.path() / "in.ply");
    options.pictures = false;
    convert(directory.path() / "in.ply", directory.path() / "site", options);
    const VerifyReport report = verify(directory.path() / "site", directory.path() / "in.ply");
    EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  }
}

TEST(X3domSite, EqualsItsSourceForEveryArrayType) {
  struct Case {
    ElementType type;
    Layout layout;
    NormalEncoding normals;
  };
  using enum NormalEncoding;
  const Case cases[] = {
      {ElementType::uint8, Layout::separate, rgb},           {ElementType::uint16, Layout::separate, spherical},
      {ElementType::int16, Layout::separate, rgb},           {ElementType::float32, Layout::separate, rgb},
      {ElementType::uint16, Layout::interleaved, spherical}, {ElementType::int16, Layout::interleaved, rgb},
      {ElementType::float32, Layout::interleaved, rgb}};
  for (const Case& arrayCase : cases)
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(std::string(nameOf(arrayCase.type)) + ", layout " + std::to_string(int(arrayCase.layout)) +
                   ", mesh " + std::to_string(seed));
      const TemporaryDirectory directory;
      Mesh mesh = testing::randomMesh(seed);
      if (arrayCase.type != ElementType::float32)
        for (Vec2f& texCoord : mesh.texCoords)
          texCoord.x = std::clamp(texCoord.x, 0.0f, 1.0f);
      ConvertOptions options = optionsFor(Encoding::bg);
      options.coordType = arrayCase.type;
      options.layout = arrayCase.layout;
      options.normals = arrayCase.normals;
      options.patchVertices = 256;
      writeMesh(mesh, directory.path() / "in.ply");
      options.pictures = false;
      convert(directory.path() / "in.ply", directory.path() / "site", options);
      const VerifyReport report = verify(directory.path() / "site", directory.path() / "in.ply");
      EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
    }
}

TEST(X3domSite, HasNoRuntimeOfImgeo) {
  const TemporaryDirectory directory;
  writeMesh(testing::torus(9, 9), directory.path() / "in.ply");
  ConvertOptions options = optionsFor(Encoding::classic);
  options.x3domUrl = "../lib";
  const ConvertReport report = convert(directory.path() / "in.ply", directory.path() / "site", options);
  EXPECT_EQ(report.x3domVersion, "1.7.2");
  EXPECT_EQ(report.x3domUrl, "../lib/x3dom.js");
  EXPECT_EQ(inspect(directory.path() / "site").runtimeBytes, 0u);
  EXPECT_FALSE(std::filesystem::exists(directory.path() / "site" / "runtime"));
}

ErrorKind kindOfConverting(const Mesh& mesh, const ConvertOptions& options) {
  const TemporaryDirectory directory;
  writeMesh(mesh, directory.path() / "in.ply");
  try {
    convert(directory.path() / "in.ply", directory.path() / "site", options);
  } catch (const Error& error) {
    EXPECT_FALSE(std::filesystem::exists(directory.path() / "site"));
    return error.kind();
  }
  ADD_FAILURE() << "was converted";
  return ErrorKind::io;
}

TEST(X3domSite, RefusesOptionsAndContentThatX3domCannotRead) {
  ConvertOptions options = optionsFor(Encoding::bg);
  options.positionBits = 17;
  EXPECT_EQ(kindOfConverting(testing::torus(9, 9), options), ErrorKind::usage);
  options = optionsFor(Encoding::classic);
  options.patchVertices = 65'536;
  EXPECT_EQ(kindOfConverting(testing::torus(9, 9), options), ErrorKind::usage);
  for (const auto& [encoding, normals] : {std::pair{Encoding::classic, NormalEncoding::octahedral},
                                          {Encoding::classic, NormalEncoding::spherical},
                                          {Encoding::bg, NormalEncoding::octahedral}}) {
    options = optionsFor(encoding);
    options.normals = normals;
    EXPECT_EQ(kindOfConverting(testing::torus(9, 9), options), ErrorKind::usage);
  }
  const auto arrays = [](ElementType type, Layout layout, std::uint32_t bits) {
    ConvertOptions typed = optionsFor(Encoding::bg);
    typed.coordType = type;
    typed.layout = layout;
    typed.positionBits = bits;
    return typed;
  };
  for (const ConvertOptions& refused :
       {arrays(ElementType::int8, Layout::separate, 0), arrays(ElementType::int16, Layout::separate, 16)})
    EXPECT_EQ(kindOfConverting(testing::torus(9, 9), refused), ErrorKind::usage);
  for (const ElementType type : {ElementType::uint8, ElementType::uint16})
    EXPECT_EQ(kindOfConverting(testing::torus(9, 9), arrays(type, Layout::interleaved, 0)), ErrorKind::unsupported);
  Mesh mesh = testing::torus(9, 9);
  mesh.texCoords[0] = {1.5f, 0};
  EXPECT_EQ(kindOfConverting(mesh, optionsFor(Encoding::classic)), ErrorKind::unsupported);
  options = {};
  options.x3domUrl = "x3dom/";
  EXPECT_EQ(kindOfConverting(testing::torus(9, 9), options), ErrorKind::usage);
}

} // namespace
} // namespace imgeo
