// Converts sites into sites: pages and documents that already hold ImageGeometry and BinaryGeometry.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "images/decode_image.h"
#include "images/encode_image.h"
#include "images/testing.h"
#include "scene/testing.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

ConvertOptions siteOptions(Encoding encoding, Target target = Target::web) {
  ConvertOptions options;
  options.target = target;
  options.encoding = encoding;
  options.effort = 0;
  options.pictures = false;
  return options;
}

/// A mesh with all attributes that every encoding holds, of several patches.
Mesh torusWithAttributes() {
  Mesh mesh = testing::torus(40, 30);
  for (Vec2f& texCoord : mesh.texCoords)
    texCoord = {std::clamp(texCoord.x, 0.0f, 1.0f), std::clamp(texCoord.y, 0.0f, 1.0f)};
  return mesh;
}

TEST(SiteAsSource, IsEncodedAgainInEachEncoding) {
  for (const Encoding from : {Encoding::classic, Encoding::compact, Encoding::bg})
    for (const Encoding to : {Encoding::classic, Encoding::compact, Encoding::bg}) {
      SCOPED_TRACE(std::to_string(int(from)) + " to " + std::to_string(int(to)));
      const TemporaryDirectory directory;
      testing::writeMesh(directory / "in.ply", torusWithAttributes());
      ConvertOptions options = siteOptions(from);
      options.patchVertices = 300;
      options.title = "Torus & more";
      const ConvertReport first = convert(directory / "in.ply", directory / "old", options);
      const ConvertReport second = convert(directory / "old/index.html", directory / "new", siteOptions(to));
      EXPECT_EQ(second.format, "HTML");
      EXPECT_EQ(second.elements.triangles, first.elements.triangles);
      EXPECT_EQ(second.encoding, to);
      EXPECT_TRUE(second.warnings.empty()) << second.warnings[0];
      const VerifyReport verified = verify(directory / "new", directory / "old/index.html");
      EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
      EXPECT_EQ(verified.site.triangles, first.elements.triangles);
      const SceneDocument scene = openDocument(directory / "new").scene;
      EXPECT_EQ(scene.graph.title, "Torus & more");
      EXPECT_EQ(scene.geometries.size(), 1u);
    }
}

TEST(SiteAsSource, HasOneShapeAgainWhereX3domHasOneForEachPatch) {
  for (const Encoding from : {Encoding::classic, Encoding::bg}) {
    const TemporaryDirectory directory;
    testing::writeMesh(directory / "in.ply", torusWithAttributes());
    ConvertOptions options = siteOptions(from, Target::x3dom);
    options.patchVertices = 300;
    const ConvertReport first = convert(directory / "in.ply", directory / "old", options);
    const ConvertReport second =
        convert(directory / "old/index.html", directory / "new", siteOptions(Encoding::compact));
    EXPECT_EQ(second.elements.triangles, first.elements.triangles);
    EXPECT_EQ(shapeNodes(openDocument(directory / "new").scene.graph).size(), 1u);
    EXPECT_TRUE(verify(directory / "new", directory / "old/index.html").equal);
  }
}

class SourcePage : public ::testing::Test {
protected:
  /// A page whose second shape is `node`. The first one is inline.
  void writePage(const std::string& node) {
    writeFile(directory_ / "in/index.html", asBytes(R"(<!DOCTYPE html><title>Old page</title><p>Unclosed
<x3d width=600px><scene><viewpoint fieldofview=0.5 position='0 0 9' description=Front></viewpoint>
<transform def=moved translation='1 2 3'>
<shape><appearance><material diffusecolor='1 0 0'></appearance><indexedfaceset coordindex='0 1 2 -1'>
<coordinate point='0 0 0 1 0 0 0 1 0'></coordinate></indexedfaceset></shape>
<shape def=second><appearance><material diffusecolor='0 1 0'></appearance>
)" + node + "</shape></transform></scene></x3d>"));
  }
  ConvertReport convertPage(bool strict = false) {
    ConvertOptions options = siteOptions(Encoding::compact);
    options.strict = strict;
    return convert(directory_ / "in/index.html", directory_ / "site", options);
  }
  std::string page() const { return std::string(asText(readFile(directory_ / "site/index.html"))); }
  void expectRefused(const std::string& node, const std::string& reason) {
    writePage(node);
    const ConvertReport report = convertPage();
    ASSERT_EQ(report.warnings.size(), 1u) << ::testing::PrintToString(report.warnings);
    EXPECT_NE(report.warnings[0].find("index.html:7:"), std::string::npos) << report.warnings[0];
    EXPECT_NE(report.warnings[0].find(reason), std::string::npos) << report.warnings[0];
    EXPECT_EQ(page().find("Geometry "), std::string::npos);
    EXPECT_NE(page().find("IndexedFaceSet"), std::string::npos) << "the rest of the scene stays";
    std::filesystem::remove_all(directory_ / "site");
    try {
      convertPage(true);
      ADD_FAILURE() << "was converted";
    } catch (const Error& error) {
      EXPECT_EQ(exitCode(error.kind()), 3) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(directory_ / "site"));
  }

  TemporaryDirectory directory_;

  void SetUp() override {
    std::filesystem::create_directory(directory_ / "in");
    Bytes coords;
    for (const float value : {0.f, 0.f, 0.f, 2.f, 0.f, 0.f, 0.f, 2.f, 0.f})
      appendLittle(coords, value);
    writeFile(directory_ / "in/c.bin", coords);
    writeFile(directory_ / "outside.bin", coords);
  }
};

TEST_F(SourcePage, KeepsItsMaterialsTransformsAndViewpoints) {
  writePage("<binarygeometry vertexcount=3 size='2 2 0' position='1 1 0' coord=c.bin solid=false></binarygeometry>");
  const ConvertReport report = convertPage(true);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
  EXPECT_EQ(report.elements.triangles, 1u);
  const std::string text = page();
  for (const char* kept :
       {"<Viewpoint fieldOfView=\"0.5\" position=\"0 0 9\" description=\"Front\"",
        "<Transform DEF=\"moved\" translation=\"1 2 3\">", "<Shape DEF=\"second\"", "<Material diffuseColor=\"0 1 0\"",
        "<IndexedFaceSet coordIndex=\"0 1 2 -1\"", "<ImageGeometry", "solid=\"false\"", "<title>Old page</title>"})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << " in " << text;
  EXPECT_EQ(text.find("600px"), std::string::npos) << "the old page's layout";
  const VerifyReport verified = verify(directory_ / "site", directory_ / "in/index.html");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
}

TEST_F(SourcePage, KeepsGeometryThatIsNotLitInItsOwnColors) {
  writePage(
      "<binarygeometry vertexcount=3 size='2 2 0' position='1 1 0' coord=c.bin lit=false></binarygeometry></shape>"
      "<shape><appearance use=glow></appearance>"
      "<binarygeometry vertexcount=3 size='2 2 0' position='1 1 0' coord=c.bin lit=false></binarygeometry></shape>"
      "<shape><appearance def=glow><material emissivecolor='0 0 1' transparency=0.5></appearance><box></box>");
  const ConvertReport report = convertPage(true);
  EXPECT_EQ(report.elements.triangles, 1u);
  EXPECT_EQ(report.instances.shapes, 1u) << "the mesh is stored once, and has both appearances";
  const std::string text = page();
  for (const char* kept :
       {"<UnlitMaterial emissiveColor=\"0 0 0\"", "<UnlitMaterial transparency=\"0.5\" emissiveColor=\"0 0 1\"",
        "<Material emissiveColor=\"0 0 1\" transparency=\"0.5\"", "<Material diffuseColor=\"1 0 0\""})
    EXPECT_NE(text.find(kept), std::string::npos) << kept << " in " << text;
  const VerifyReport verified = verify(directory_ / "site", directory_ / "in/index.html");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);

  const SceneDocument direct = openDocument(directory_ / "in").scene; // without convert
  std::vector<AnyMaterial> materials;
  for (const std::size_t node : shapeNodes(direct.graph))
    materials.push_back(direct.graph.appearances.at(*shapeOf(direct.graph, node).appearance).material);
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0], AnyMaterial(UnlitMaterial{.emissiveColor = {0, 0, 0}}));
  EXPECT_TRUE(std::holds_alternative<UnlitMaterial>(materials[1]));
  const VerifyReport foreign = verify(directory_ / "in", directory_ / "in/index.html");
  EXPECT_TRUE(foreign.equal) << ::testing::PrintToString(foreign.findings);
  std::string lit(asText(readFile(directory_ / "in/index.html")));
  for (std::size_t at = lit.find("lit=false"); at != lit.npos; at = lit.find("lit=false"))
    lit.replace(at, 9, "lit=true ");
  writeFile(directory_ / "in/lit.html", asBytes(lit));
  const VerifyReport other = verify(directory_ / "in", directory_ / "in/lit.html");
  EXPECT_NE(::testing::PrintToString(other.findings).find("2 of 2 shapes are lit in the site and not in the input"),
            std::string::npos)
      << ::testing::PrintToString(other.findings);
}

TEST_F(SourcePage, LosesGeometryWhoseFilesCannotBeReadWithOneWarning) {
  const std::string begin = "<binarygeometry vertexcount=3 size='2 2 0' coord=";
  expectRefused(begin + "missing.bin></binarygeometry>", "missing.bin");
  expectRefused(begin + "../outside.bin></binarygeometry>", "outside of the folder");
  expectRefused(begin + "https://example.org/c.bin></binarygeometry>", "https://example.org/c.bin");
  expectRefused(begin + "c.bin coordtype=Float64></binarygeometry>", "coordType");
  expectRefused("<binarygeometry vertexcount=12 coord=c.bin></binarygeometry>", "c.bin");
  expectRefused(
      "<imagegeometry vertexcount=3><imagetexture containerfield=coord url=c.bin></imagetexture></imagegeometry>",
      "c.bin");
}

TEST_F(SourcePage, TakesTheFirstUrlOfAFileThatCanBeRead) {
  const std::string fields = "vertexcount=3 size='2 2 0' position='1 1 0'";
  writePage("<binarygeometry " + fields +
            R"( coord='"lost.bin" "https://example.org/c.bin" "c.bin"'></binarygeometry>)");
  const ConvertReport report = convertPage(true);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
  EXPECT_EQ(report.elements.triangles, 1u);
  EXPECT_EQ(inspect(directory_ / "in").elements.triangles, 1u);
  EXPECT_EQ(exportSite(directory_ / "in", directory_ / "out.ply").elements.triangles, 2u); // and one of the document
  EXPECT_TRUE(verify(directory_ / "in", directory_ / "in/index.html").equal);

  const std::string lost = "<binarygeometry " + fields + R"( coord='"lost.bin" "gone.bin"'></binarygeometry>)";
  expectRefused(lost, "lost.bin: ");
  expectRefused(lost, "gone.bin: ");
  try {
    inspect(directory_ / "in");
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("lost.bin: "), text.npos) << text;
    EXPECT_NE(text.find("gone.bin: "), text.npos) << text;
  }
}

TEST_F(SourcePage, TakesTheFirstUrlOfATextureThatDecodes) {
  const Bytes good = encodeLosslessWebp(testing::testRaster(8, 8));
  writeFile(directory_ / "in/good.webp", good);
  writeFile(directory_ / "in/broken.webp", ByteSpan(good).first(good.size() / 2)); // of the right type, but cut
  writeFile(directory_ / "in/other.webp", encodeLosslessWebp(testing::testRaster(4, 4)));
  writePage("<binarygeometry vertexcount=3 size='2 2 0' position='1 1 0' coord=c.bin></binarygeometry></shape><shape>"
            R"(<appearance><imagetexture url='"lost.webp" "broken.webp" "good.webp" "other.webp"'></imagetexture>)"
            "</appearance><binarygeometry vertexcount=3 size='2 2 0' position='1 1 0' coord=c.bin texcoord=c.bin>"
            "</binarygeometry>");
  EXPECT_TRUE(convertPage(true).warnings.empty());
  const auto edgeOf = [](const std::filesystem::path& file) { return decodeRaster(readFile(file), "").width; };
  const SceneDocument site = openDocument(directory_ / "site").scene;
  ASSERT_EQ(site.graph.images.size(), 1u);
  EXPECT_EQ(edgeOf(directory_ / "site" / site.graph.images[0].url), 8u);
  EXPECT_TRUE(verify(directory_ / "site", directory_ / "in/index.html").equal);

  const SceneDocument direct = openDocument(directory_ / "in").scene; // without convert
  ASSERT_EQ(direct.graph.images.size(), 1u);
  EXPECT_EQ(direct.graph.images[0].url, "good.webp");
  const SiteInfo info = inspect(directory_ / "in");
  EXPECT_EQ(info.textureBytes, good.size());
  EXPECT_TRUE(info.missing.empty());
  exportSite(directory_ / "in", directory_ / "out.glb");
  const Bytes glb = readFile(directory_ / "out.glb");
  EXPECT_FALSE(std::ranges::search(glb, good).empty());
}

TEST(SourceDocument, IsReadWithTheFilesOfItsGeometry) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "in.ply", torusWithAttributes());
  convert(directory / "in.ply", directory / "old", siteOptions(Encoding::classic));
  const ConvertReport report = convert(directory / "old/scene.x3d", directory / "new", siteOptions(Encoding::compact));
  EXPECT_EQ(report.elements.triangles, torusWithAttributes().elementCount());
  EXPECT_TRUE(verify(directory / "new", directory / "old/scene.x3d").equal);
}

} // namespace
} // namespace imgeo
