// Converts an X3D document and checks that the site keeps its content and equals its source.

#include "base/file.h"
#include "base/testing.h"
#include "containers/png/png.h"
#include "scene/fog_depths.h"
#include "transcode/site/staged_site.h"
#include "transcode/site/testing.h"

#include <gtest/gtest.h>
#include <pugixml.hpp>

namespace imgeo {
namespace {

/// Coordinates that no face uses. They make the geometry large enough to be stored in a file of its own.
const std::string unusedPoints = [] {
  std::string points;
  for (int i = 0; i < 200; ++i)
    points += " 9 9 " + std::to_string(i);
  return points;
}();

const std::string source = R"(<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE X3D PUBLIC "ISO//Web3D//DTD X3D 3.3//EN" "http://www.web3d.org/specifications/x3d-3.3.dtd">
<!-- Drawn by somebody & others -->
<X3D profile="Immersive" version="3.3">
  <head><meta name="creator" content="somebody"/></head>
  <Scene>
    <WorldInfo title="A hall"/>
    <NavigationInfo type='"WALK"' headlight="false"/>
    <Viewpoint DEF="Door" position="0 1.6 8"/>
    <Script DEF="S" url="javascript:x"/>
    <Switch whichChoice="0"><!-- one row -->
      <Transform DEF="Seat" translation="1 0 0" id="first">
        <Shape class="seat"><Appearance DEF="Red"><Material diffuseColor="1 0 0"/></Appearance>
          <IndexedFaceSet DEF="Plate" coordIndex="0 1 2 3 -1"><Coordinate point="0 0 0 1 0 0 1 1 0 0 1 0)" +
                           unusedPoints + R"("/></IndexedFaceSet>
        </Shape>
      </Transform>
    </Switch>
    <Transform translation="0 0 5" rotation="0 1 0 0" scale="1.0 1 1"><Transform USE="Seat"/></Transform>
    <Shape><Appearance USE="Red"/><IndexedFaceSet USE="Plate"/></Shape>
    <Shape><Box size="1 2 3"/></Shape>
    <Shape><TriangleSet><Coordinate point="0 0 0 1 0 0 0 1 0"/></TriangleSet></Shape>
  </Scene>
</X3D>
)";

bool isGeometry(std::string_view element) {
  return element == "IndexedFaceSet" || element == "ImageGeometry";
}

/// Appends one line for each element, indented by its depth, with its name and fields, and one for each comment. Leaves
/// out geometry nodes and the bounding box fields that convert adds.
void outline(pugi::xml_node parent, std::size_t depth, std::vector<std::string>& lines) {
  for (const pugi::xml_node& node : parent.children()) {
    if (isGeometry(node.name()) || node.type() == pugi::node_doctype)
      continue;
    std::string line = std::string(depth, ' ') + node.name();
    for (const pugi::xml_attribute& attribute : node.attributes())
      if (!std::string_view(attribute.name()).starts_with("bbox"))
        line += std::string(" ") + attribute.name() + "=" + attribute.value();
    lines.push_back(line + node.value());
    outline(node, depth + 1, lines);
  }
}

std::vector<std::string> outlineOf(const std::string& text) {
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(text.c_str(), pugi::parse_default | pugi::parse_comments));
  std::vector<std::string> lines;
  outline(document, 0, lines);
  return lines;
}

class X3dSite : public ::testing::Test {
protected:
  X3dSite() {
    writeFile(directory_ / "hall.x3d", asBytes(source));
    report = convert(directory_ / "hall.x3d", directory_ / "site", {});
    page = asText(readFile(directory_ / "site/index.html"));
    file = asText(readFile(directory_ / "site/scene.x3d"));
  }

  testing::TemporaryDirectory directory_;
  ConvertReport report;
  std::string page, file;
};

TEST_F(X3dSite, KeepsAllContentButGeometry) {
  for (const char* kept : {"<WorldInfo title=\"A hall\">", "<NavigationInfo type='\"WALK\"' headlight=\"false\">",
                           "<Viewpoint DEF=\"Door\" position=\"0 1.6 8\">", "<Switch whichChoice=\"0\">",
                           "<Transform DEF=\"Seat\" translation=\"1 0 0\" id=\"first\">", "<Shape class=\"seat\"",
                           "<Material diffuseColor=\"1 0 0\">", "<Transform USE=\"Seat\">", "<Appearance USE=\"Red\">",
                           "<Box size=\"1 2 3\">"})
    for (const std::string& text : {page, file})
      EXPECT_NE(text.find(kept), std::string::npos) << kept << "\n" << text;
  EXPECT_EQ(page.find("IndexedFaceSet"), std::string::npos);
  EXPECT_EQ(page.find("<Script"), std::string::npos);
  EXPECT_EQ(file.find("<Script"), std::string::npos);
  EXPECT_NE(file.find("<meta name=\"creator\" content=\"somebody\">"), std::string::npos);
  ASSERT_FALSE(report.warnings.empty());
  EXPECT_NE(report.warnings.front().find("Script (1) left out"), std::string::npos) << report.warnings.front();
  EXPECT_EQ(page.find("<DirectionalLight"), std::string::npos) << "a light was added";
}

TEST_F(X3dSite, ChangesNothingButGeometryNodesAndScripts) {
  std::vector<std::string> before = outlineOf(source), after = outlineOf(file);
  // A comment before <X3D> becomes the first child of the Scene.
  ASSERT_EQ(before.at(0), " Drawn by somebody & others ");
  const auto moved = std::ranges::find(after, "   Drawn by somebody & others ");
  ASSERT_NE(moved, after.end());
  before.erase(before.begin());
  after.erase(moved);
  EXPECT_EQ(std::erase_if(before, [](const std::string& line) { return line.starts_with("  Script"); }), 1u);
  EXPECT_EQ(after, before);
}

TEST_F(X3dSite, PreloadsNothingThatMayStayInvisible) {
  const std::string plate =
      source.substr(source.find("<IndexedFaceSet"), source.find("</Shape>") - source.find("<IndexedFaceSet"));
  writeFile(directory_ / "lod.x3d",
            asBytes("<X3D><Scene><LOD range='5'><Group/><Shape>" + plate + "</Shape></LOD></Scene></X3D>"));
  convert(directory_ / "lod.x3d", directory_ / "lod", {});
  const Bytes lod = readFile(directory_ / "lod/index.html");
  EXPECT_EQ(asText(lod).find("rel=\"preload\""), std::string::npos);
  EXPECT_NE(page.find("rel=\"preload\""), std::string::npos) << "the plate also has an instance outside of the Switch";
}

TEST_F(X3dSite, StoresAGeometryThatIsUsedOnce) {
  EXPECT_EQ(report.elements.triangles, 2u);
  EXPECT_EQ(inspect(directory_ / "site").geometries.size(), 1u);
}

TEST_F(X3dSite, EqualsItsSourceAndCanBeExported) {
  const VerifyReport verified = verify(directory_ / "site", directory_ / "hall.x3d");
  EXPECT_TRUE(verified.equal) << verified.findings.at(0);
  const ExportReport exported = exportSite(directory_ / "site", directory_ / "hall.ply");
  EXPECT_EQ(exported.elements.triangles, 3 * 2u + 12 + 1); // the seats, the box and the triangle
}

TEST(X3dSiteWithFog, KeepsTheDepthsOfItsGeometry) {
  const testing::TemporaryDirectory directory;
  const std::filesystem::path input = directory / "fog.x3d", site = directory / "site";
  writeFile(input,
            asBytes("<X3D><Scene><Fog visibilityRange='9'/><Shape><IndexedFaceSet coordIndex='0 1 2 3'>"
                    "<Coordinate point='0 0 0 1 0 0 1 1 0 0 1 0" +
                    unusedPoints + "'/><FogCoordinate depth='0 0 0.75'/></IndexedFaceSet></Shape></Scene></X3D>"));
  const ConvertReport report = convert(input, site, {});
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  ASSERT_EQ(report.attributes.size(), 1u);
  EXPECT_EQ(report.attributes[0].name, fogDepthName);
  EXPECT_TRUE(verify(site, input).findings.empty());
  convert(site / "index.html", directory / "again", {});
  EXPECT_TRUE(verify(directory / "again", input).findings.empty());

  ConvertOptions options;
  options.target = Target::x3dom;
  const ConvertReport forX3dom = convert(input, directory / "x3dom", options);
  EXPECT_TRUE(forX3dom.attributes.empty());
  ASSERT_EQ(forX3dom.warnings.size(), 1u);
  EXPECT_NE(forX3dom.warnings[0].find("depths in fog"), std::string::npos);
  EXPECT_TRUE(verify(directory / "x3dom", input).findings.empty());
}

TEST(X3dSiteWithBackground, CopiesItsPicturesAndEqualsItsSource) {
  const testing::TemporaryDirectory directory;
  const Bytes png = encodePng(Image{1, 1, 3, {255, 0, 0}, {}}, 1);
  writeFile(directory / "front.png", png);
  writeFile(directory / "scene.x3d",
            asBytes("<X3D><Scene><Background skyColor='0 0 1' frontUrl='\"front.png\"'/><TextureBackground>"
                    "<ImageTexture containerField='topTexture' url='front.png'/></TextureBackground>"
                    "<Shape><Box/></Shape></Scene></X3D>"));
  const ConvertReport report = convert(directory / "scene.x3d", directory / "site", {});
  EXPECT_EQ(report.warnings, std::vector<std::string>{});
  const std::string url = "textures/" + contentName(png) + ".png";
  EXPECT_EQ(readFile(directory / "site" / url), png);
  for (const char* document : {"site/index.html", "site/scene.x3d"}) {
    const std::string text(asText(readFile(directory / document)));
    EXPECT_NE(text.find("frontUrl='\"" + url + "\"'"), std::string::npos) << text;
    EXPECT_NE(text.find(" url='\"" + url + "\"'"), std::string::npos) << text;
  }
  EXPECT_TRUE(verify(directory / "site", directory / "scene.x3d").findings.empty());
  std::filesystem::remove(directory / "site" / url);
  EXPECT_FALSE(verify(directory / "site", directory / "scene.x3d").findings.empty());
}

} // namespace
} // namespace imgeo
