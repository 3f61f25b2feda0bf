// Converts damaged sources: each fault gives one warning, and the site has everything else.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A strip of a thousand triangles, too large to stay in the document.
std::string strip() {
  std::string points;
  for (int i = 0; i < 1002; ++i)
    points += std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0 ";
  return "<TriangleStripSet stripCount='1002'><Coordinate point='" + points + "'/></TriangleStripSet>";
}

class DamagedSource : public ::testing::Test {
protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    writeFile(directory_ / name, asBytes(text));
    return directory_ / name;
  }
  /// Converts a document with these nodes.
  ConvertReport convertNodes(const std::string& nodes, const ConvertOptions& options = {}) {
    return convert(write("a.x3d", "<X3D><Scene>\n" + nodes + "</Scene></X3D>"), directory_ / "site", options);
  }
  /// Converts the nodes. Expects one warning, which contains `words`, a site that equals its source, and that `strict`
  /// refuses the source.
  void expectWarning(const std::string& nodes, const std::string& words) {
    const ConvertReport report = convertNodes(nodes);
    ASSERT_EQ(report.warnings.size(), 1u) << nodes << ::testing::PrintToString(report.warnings);
    EXPECT_NE(report.warnings[0].find(words), std::string::npos) << report.warnings[0];
    EXPECT_EQ(report.warnings[0].find(directory_ / "."), std::string::npos) << report.warnings[0];
    const VerifyReport verified = verify(directory_ / "site", directory_ / "a.x3d");
    EXPECT_TRUE(verified.equal) << nodes << ::testing::PrintToString(verified.findings);
    ConvertOptions strict;
    strict.strict = true;
    EXPECT_THROW(convertNodes(nodes, strict), Error) << nodes;
  }

  testing::TemporaryDirectory directory_;
};

TEST_F(DamagedSource, MalformedFieldsCountAsAbsent) {
  expectWarning("<Viewpoint position='a b c'/>", "index.html:16: Viewpoint: position=\"a b c\" is no SFVec3f");
  expectWarning("<OrthoViewpoint fieldOfView='1 2'/>", "fieldOfView=\"1 2\" is no SFVec4f");
  expectWarning("<DirectionalLight direction='down'/>", "direction=\"down\" is no SFVec3f");
  expectWarning("<Background skyColor='blue'/>", "skyColor=\"blue\" is no");
  expectWarning("<NavigationInfo headlight='yes'/>", "headlight=\"yes\" is no SFBool");
  for (const char* appearance : {"<Material diffuseColor='red'/>", "<Material diffuseColor='1 0'/>",
                                 "<TextureTransform scale='two'/>", "<Material USE='nobody'/>"})
    expectWarning(std::string("<Shape><Appearance>") + appearance + "</Appearance>" + strip() + "</Shape>", "");
  expectWarning("<Group bboxSize='a b c'><Shape>" + strip() + "</Shape></Group>", "bboxSize=\"a b c\" is no SFVec3f");
}

TEST_F(DamagedSource, KeepsUrlsOfMissingTexturesAndOfTexturesOutsideItsFolder) {
  for (const std::string url : {"lost.png", "../out.png", "/etc/hostname"}) {
    expectWarning("<Shape><Appearance><ImageTexture url='\"" + url + "\"'/></Appearance>" + strip() + "</Shape>", url);
    EXPECT_EQ(inspect(directory_ / "site").missing, std::vector<std::string>{url});
  }
  // A texture that convert has written must not be missing.
  write("grey.pgm", "P5 1 1 255\nx");
  convertNodes("<Shape><Appearance><ImageTexture url='\"grey.pgm\"'/></Appearance>" + strip() + "</Shape>");
  ASSERT_TRUE(verify(directory_ / "site", directory_ / "a.x3d").equal);
  std::filesystem::remove_all(directory_ / "site/textures");
  EXPECT_FALSE(verify(directory_ / "site", directory_ / "a.x3d").equal);
}

TEST_F(DamagedSource, MayHaveShapesWithoutGeometry) {
  for (const std::string shape : {"<Shape/>", "<Shape><Appearance><Material/></Appearance></Shape>"}) {
    EXPECT_TRUE(convertNodes(shape + "<Shape>" + strip() + "</Shape>").warnings.empty());
    EXPECT_TRUE(verify(directory_ / "site", directory_ / "a.x3d").equal);
  }
  const std::vector<std::string> warnings =
      convertNodes("<Shape><IndexedFaceSet/></Shape><Shape>" + strip() + "</Shape>").warnings;
  EXPECT_EQ(warnings, std::vector<std::string>{"Geometry without faces, lines or points: IndexedFaceSet (1)."});
}

TEST_F(DamagedSource, IsReadEvenIfItsGeometryIsSmall) {
  const std::string coordinate = "<Coordinate point='0 0 0 1 0 0 0 1 0'/>";
  expectWarning("<Shape><IndexedTriangleSet index='0 1 7'>" + coordinate + "</IndexedTriangleSet></Shape>",
                "position 7 of 3");
  expectWarning("<Shape><ElevationGrid xDimension='100000' zDimension='100000' height='0'/></Shape>", "ElevationGrid");
}

TEST_F(DamagedSource, WithMoreThanAMillionShapeInstancesIsRefused) {
  for (const std::string& geometry : {strip(), std::string("<Box/>")}) {
    std::string nodes = "<Group DEF='g0'><Shape>" + geometry + "</Shape></Group>";
    for (int i = 1; i <= 40; ++i) {
      const std::string inner = "<Group USE='g" + std::to_string(i - 1) + "'/>";
      nodes += "<Group DEF='g" + std::to_string(i) + "'>" + inner + inner + "</Group>";
    }
    try {
      convertNodes(nodes);
      FAIL() << "was converted";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::limit);
      EXPECT_NE(error.message().find("million shapes"), std::string::npos) << error.message();
    }
  }
}

TEST_F(DamagedSource, DefaultViewpointIgnoresShapesThatCannotBeDrawn) {
  const std::string gltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 2]}],
    "nodes": [{"scale": [1e38, 1e38, 1e38], "children": [1]}, {"scale": [1e38, 1e38, 1e38], "mesh": 0}, {"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
    "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  const ConvertReport report = convert(write("a.gltf", gltf), directory_ / "site", {});
  ASSERT_EQ(report.warnings.size(), 1u) << ::testing::PrintToString(report.warnings);
  EXPECT_TRUE(report.warnings[0].starts_with("1 shape is scaled by more than 10^15")) << report.warnings[0];
  const Bytes page = readFile(directory_ / "site/index.html");
  EXPECT_NE(asText(page).find("centerOfRotation=\"0.5 0.5 0\""), std::string::npos) << asText(page);
}

} // namespace
} // namespace imgeo
