// Converts meshes without normals: which edges are sharp, and what the user is told.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "scene/testing.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

constexpr const char* advice = "--crease-angle 45 keeps them sharp";

/// A cube of eight vertices, moved along x.
std::string objCube(double x = 0) {
  std::string text = "o cube\n";
  for (const char* vertex : {"0 0", "1 0", "1 1", "0 1"})
    text += fmt::format("v {0} {1}\nv {2} {1}\n", x, vertex, x + 1);
  for (const char* face : {"1 3 5 7", "2 8 6 4", "1 2 4 3", "5 6 8 7", "3 4 6 5", "1 7 8 2"})
    text += fmt::format("f {}\n", face);
  return text;
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

bool hasWarning(const ConvertReport& report) {
  return std::ranges::any_of(report.warnings,
                             [](const std::string& each) { return each.find(advice) != std::string::npos; });
}

TEST_F(CreaseAngle, DividesTheVerticesOfACube) {
  EXPECT_EQ(convertText("cube.obj", objCube()).vertices, 8u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 180).vertices, 8u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 91).vertices, 8u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 45).vertices, 24u);
  EXPECT_EQ(convertText("cube.obj", objCube(), 0).vertices, 24u);
}

TEST_F(CreaseAngle, HasADefaultInFormatsOfManMadeObjects) {
  const std::string cube = "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                           "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 2 3 7 6\n4 1 2 6 5\n4 0 4 7 3\n";
  const ConvertReport report = convertText("cube.off", cube);
  EXPECT_EQ(report.vertices, 24u);
  EXPECT_FALSE(hasWarning(report));
  EXPECT_EQ(convertText("cube.off", cube, 180).vertices, 8u);
}

TEST_F(CreaseAngle, IsSuggestedForManMadeObjectsWithSmoothNormals) {
  EXPECT_TRUE(hasWarning(convertText("cube.obj", objCube())));
  EXPECT_FALSE(hasWarning(convertText("cube.obj", objCube(), 45)));
  EXPECT_FALSE(hasWarning(convertText("cube.obj", objCube(), 180)));
  Mesh torus = testing::torus(40, 20);
  torus.normals.clear();
  testing::writeMesh(directory_ / "torus.ply", torus);
  EXPECT_FALSE(hasWarning(convert(directory_ / "torus.ply", directory_ / "site", {})));
}

TEST_F(CreaseAngle, IsRefusedForSequences) {
  std::vector<std::filesystem::path> files;
  for (const int frame : {0, 1}) {
    files.push_back(directory_ / fmt::format("frame-{}.obj", frame));
    writeFile(files.back(), asBytes(objCube(frame)));
  }
  ConvertOptions options;
  EXPECT_FALSE(hasWarning(convertSequence(files, directory_ / "frames", options)));
  options.creaseDegrees = 45;
  EXPECT_THROW(convertSequence(files, directory_ / "frames", options), Error);
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
