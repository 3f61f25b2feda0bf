// Converts meshes without normals: which edges are sharp, and whether that is a guess.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "import/gltf/testing.h"
#include "scene/testing.h"
#include "transcode/site/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A cube of eight vertices, moved along x.
std::string objCube(double x = 0) {
  std::string text = "o cube\n";
  for (const char* vertex : {"0 0", "1 0", "1 1", "0 1"})
    text += fmt::format("v {0} {1}\nv {2} {1}\n", x, vertex, x + 1);
  for (const char* face : {"1 3 5 7", "2 8 6 4", "1 2 4 3", "5 6 8 7", "3 4 6 5", "1 7 8 2"})
    text += fmt::format("f {}\n", face);
  return text;
}

/// A cube without normals.
Bytes glbCube() {
  testing::GltfText gltf;
  const std::size_t positions =
      gltf.addAccessor<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1}, "VEC3", 5126);
  const std::size_t indices = gltf.addAccessor<std::uint8_t>(
      {0, 3, 2, 0, 2, 1, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6, 1, 2, 6, 1, 6, 5, 0, 4, 7, 0, 7, 3},
      "SCALAR", 5121);
  gltf.show(gltf.addMesh({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}));
  return gltf.glb();
}

class CreaseAngle : public ::testing::Test {
protected:
  ConvertReport convertText(const std::string& name, const std::string& text, std::optional<double> degrees = {}) {
    writeFile(directory_ / name, asBytes(text));
    ConvertOptions options;
    options.creaseDegrees = degrees;
    const ConvertReport report = convert(directory_ / name, directory_ / "site", options);
    const VerifyReport verified = verify(directory_ / "site", directory_ / name);
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    return report;
  }

  testing::TemporaryDirectory directory_;
};

TEST_F(CreaseAngle, DividesTheVerticesOfACube) {
  EXPECT_EQ(convertText("cube.obj", objCube(), 180).vertices, 8u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 91).vertices, 8u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 45).vertices, 24u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 1).vertices, 24u);
}

TEST_F(CreaseAngle, HasADefaultInFormatsOfManMadeObjects) {
  const std::string roof = "0\nSECTION\n2\nENTITIES\n{}{}0\nENDSEC\n0\nEOF\n"; // two faces of a DXF file
  const auto face = [](double width) {
    return fmt::format("0\n3DFACE\n8\n0\n10\n0\n20\n0\n30\n1\n11\n0\n21\n1\n31\n1\n12\n{0}\n22\n1\n32\n0\n"
                       "13\n{0}\n23\n0\n33\n0\n",
                       width);
  };
  const std::string text = fmt::format(fmt::runtime(roof), face(-1), face(1));
  const ConvertReport report = convertText("roof.dxf", text);
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_EQ(report.edges.guessedSharp + report.edges.guessedSmooth, 0u);
  EXPECT_EQ(convertText("roof.dxf", text, 180).vertices, 6u);
}

TEST_F(CreaseAngle, IsGuessedByTheShape) {
  const ConvertReport cube = convertText("cube.obj", objCube());
  EXPECT_EQ(cube.vertices, 24u);
  EXPECT_EQ(cube.edges.guessedSharp, 1u);
  EXPECT_EQ(cube.edges.guessedSmooth, 0u);
  for (const double degrees : {45.0, 180.0}) {
    const ConvertReport stated = convertText("cube.obj", objCube(), degrees);
    EXPECT_EQ(stated.edges.guessedSharp + stated.edges.guessedSmooth, 0u);
  }
  Mesh torus = testing::torus(40, 20);
  torus.normals.clear();
  testing::writeMesh(directory_ / "torus.ply", torus);
  const ConvertReport smooth = convert(directory_ / "torus.ply", directory_ / "site", {});
  EXPECT_EQ(smooth.edges.guessedSharp, 0u);
  EXPECT_EQ(smooth.edges.guessedSmooth, 1u);
  EXPECT_EQ(smooth.vertices, torus.wedgeCount());
  EXPECT_TRUE(verify(directory_ / "site", directory_ / "torus.ply").equal);
}

TEST_F(CreaseAngle, IsGuessedForEachMesh) {
  std::string text = objCube(5) + "o torus\n";
  const Mesh torus = testing::torus(40, 20);
  for (const Vec3f& position : torus.positions)
    text += fmt::format("v {} {} {}\n", position.x, position.y, position.z);
  for (std::size_t corner = 0; corner < torus.corners.size(); ++corner)
    text += fmt::format("{}{}", corner % 3 == 0 ? "\nf " : " ", torus.wedgePositions[torus.corners[corner]] + 9);
  const ConvertReport report = convertText("both.obj", text);
  EXPECT_EQ(report.edges.guessedSharp, 1u);
  EXPECT_EQ(report.edges.guessedSmooth, 1u);
  EXPECT_EQ(report.vertices, 24 + torus.positions.size());
}

TEST_F(CreaseAngle, IsThatOfTheFormatWhereItSaysSo) {
  const std::string cube = "#VRML V2.0 utf8\nShape { geometry IndexedFaceSet { creaseAngle 4 solid FALSE coordIndex ["
                           "0 3 2 1 -1 4 5 6 7 -1 0 1 5 4 -1 2 3 7 6 -1 1 2 6 5 -1 0 4 7 3] coord Coordinate { point ["
                           "0 0 0, 1 0 0, 1 1 0, 0 1 0, 0 0 1, 1 0 1, 1 1 1, 0 1 1] } } }\n";
  writeFile(directory_ / "cube.wrl", asBytes(cube + std::string(2000, ' ')));
  ConvertOptions options;
  options.encoding = Encoding::compact;
  const ConvertReport report = convert(directory_ / "cube.wrl", directory_ / "site", options);
  EXPECT_EQ(report.edges.guessedSharp + report.edges.guessedSmooth, 0u);
}

TEST_F(CreaseAngle, IsNoneInSitesOfEarlierVersions) {
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>{"cube.obj", objCube()}, {"cube.glb", std::string(asText(glbCube()))}}) {
    convertText(name, text, 180);
    const std::filesystem::path manifest = directory_ / "site" / "imgeo.json";
    std::string json(asText(readFile(manifest)));
    const std::string stated = "\"creaseDegrees\": 180.0,";
    const std::size_t at = json.find(stated);
    ASSERT_NE(at, std::string::npos);
    writeFile(manifest, asBytes(json.erase(at, stated.size())));
    const VerifyReport verified = verify(directory_ / "site", directory_ / name);
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  }
}

TEST_F(CreaseAngle, IsRefusedForSequences) {
  std::vector<std::filesystem::path> files;
  for (const int frame : {0, 1}) {
    files.push_back(directory_ / fmt::format("frame-{}.obj", frame));
    writeFile(files.back(), asBytes(objCube(frame)));
  }
  ConvertOptions options;
  const ConvertReport report = convertSequence(files, directory_ / "frames", options);
  EXPECT_EQ(report.edges.guessedSharp, 0u);
  EXPECT_EQ(report.vertices, 8u);
  options.creaseDegrees = 45;
  EXPECT_THROW(convertSequence(files, directory_ / "frames", options), Error);
}

TEST_F(CreaseAngle, IsZeroInGltfWhoseTrianglesAreFlatWithoutNormals) {
  const std::string glb(asText(glbCube()));
  const ConvertReport flat = convertText("cube.glb", glb);
  EXPECT_EQ(flat.edges.flat, 1u);
  EXPECT_FALSE(flat.hasNormals);
  EXPECT_FALSE(flat.normalsComputed);
  EXPECT_EQ(flat.vertices, 8u);
  EXPECT_EQ(convertText("cube.glb", glb, 0).edges.flat, 1u);
  const ConvertReport smooth = convertText("cube.glb", glb, 180);
  EXPECT_EQ(smooth.edges.flat, 0u);
  EXPECT_TRUE(smooth.normalsComputed);
  EXPECT_EQ(smooth.vertices, 8u);

  ConvertOptions options;
  options.target = Target::x3dom; // which lights no triangles without normals
  const ConvertReport divided = convert(directory_ / "cube.glb", directory_ / "site", options);
  EXPECT_EQ(divided.edges.flat, 0u);
  EXPECT_EQ(divided.vertices, 24u);
  EXPECT_TRUE(verify(directory_ / "site", directory_ / "cube.glb").equal);

  options = {};
  options.form = MeshForm::geometryImage; // whose triangles are others
  const ConvertReport sampled = convert(directory_ / "cube.glb", directory_ / "site", options);
  EXPECT_TRUE(sampled.hasNormals);
  EXPECT_TRUE(verify(directory_ / "site", directory_ / "cube.glb").equal);
}

TEST_F(CreaseAngle, OfZeroNeedsNoNormals) {
  const ConvertReport report = convertText("cube.obj", objCube(), 0);
  EXPECT_EQ(report.edges.flat, 1u);
  EXPECT_EQ(report.vertices, 8u);
  EXPECT_FALSE(report.hasNormals);
}

TEST_F(CreaseAngle, OfAManifestIsAnAngle) {
  convertText("cube.obj", objCube(), 45);
  const std::filesystem::path manifest = directory_ / "site" / "imgeo.json";
  std::string text(asText(readFile(manifest)));
  const std::size_t at = text.find("45.0");
  ASSERT_NE(at, std::string::npos);
  writeFile(manifest, asBytes(text.replace(at, 4, "-1.0")));
  EXPECT_THROW(verify(directory_ / "site", directory_ / "cube.obj"), Error);
}

} // namespace
} // namespace imgeo
