#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"
#include "transcode/site/testing.h"
#include "transcode/transform/transform_file.h"

#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

/// Adds the field `operators` to the geometry nodes of a site.
void addOperators(const std::filesystem::path& site, const std::string& operators) {
  for (const char* name : {"index.html", "scene.x3d"}) {
    const Bytes bytes = readFile(site / name);
    std::string text(bytes.begin(), bytes.end());
    for (const std::string node : {"<ImageGeometry", "<BinaryGeometry"})
      for (std::size_t at = text.find(node); at != std::string::npos; at = text.find(node, at + 1))
        text.insert(at + node.size(), " operators='" + operators + "'");
    writeFile(site / name, asBytes(text));
  }
}

void expectSiteEquals(const std::filesystem::path& site, const std::filesystem::path& input, bool isEqual = true) {
  const VerifyReport report = verify(site, input);
  EXPECT_EQ(report.equal, isEqual) << input << ": " << fmt::format("{}", fmt::join(report.findings, " "));
}

ErrorKind kindOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.kind();
  }
  ADD_FAILURE() << "nothing was thrown";
  return ErrorKind::io;
}

/// A third of the lists mirror.
const std::vector<std::string> lists{"negate(y)", "scale(0.7 0.9 0.8) swizzle(yxz) translate(0.05 -0.1 0)",
                                     "gamma(1.3) solarize(0.8)", "posterise(9) threshold(0.1 0.9)"};

TEST(TransformFile, WritesWhatAPageOfTheConvertedFileShowsWithTheSameOperators) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  testing::writeMesh(path("torus.ply"), testing::torus(20, 16));
  const Encoding encodings[] = {Encoding::classic, Encoding::compact, Encoding::bg, Encoding::classic};
  for (std::size_t i = 0; i < lists.size(); ++i) {
    SCOPED_TRACE(lists[i]);
    ConvertOptions options;
    options.encoding = encodings[i];
    options.patchVertices = 256;
    options.effort = 0;
    options.force = true;
    options.pictures = false;
    convert(path("torus.ply"), path("site"), options);
    addOperators(path("site"), lists[i]);
    const bool collapses = i == 3; // points near a step may fall to either side of it
    for (const char* format : {"out.ply", "out.obj"}) {
      transformFile(path("torus.ply"), path(format), lists[i], false);
      if (!collapses)
        expectSiteEquals(path("site"), path(format));
    }
    exportSite(path("site"), path("out.ply"));
    expectSiteEquals(path("site"), path("out.ply"));
    expectSiteEquals(path("site"), path("torus.ply"), false);
    // A conversion of the page writes the mapped mesh, which has no operators any more.
    convert(path("site") / "index.html", path("again"), options);
    expectSiteEquals(path("again"), path("site") / "index.html");
    const Bytes page = readFile(path("again") / "scene.x3d");
    EXPECT_EQ(std::string(page.begin(), page.end()).find("operators"), std::string::npos);
  }
}

/// The standard deviation of the distances of a mesh's points from the origin.
double roughnessOf(const SiteMesh& mesh) {
  double sum = 0, squares = 0;
  for (const auto& [x, y, z] : mesh.positions) {
    const double radius = length(Vec3d{x, y, z});
    sum += radius;
    squares += radius * radius;
  }
  const auto count = static_cast<double>(mesh.positions.size());
  return std::sqrt(squares / count - sum * sum / count / count);
}

TEST(TransformFile, SmoothsTheGeometryImagesOfASite) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  Mesh bumpy = testing::sphere(40, 60);
  testing::Random random(1);
  for (Vec3f& position : bumpy.positions)
    position = position * random.between(0.98F, 1.02F);
  testing::writeMesh(path("bumpy.ply"), bumpy);
  ConvertOptions options;
  options.form = MeshForm::geometryImage;
  options.grid = 128;
  options.pictures = false;
  convert(path("bumpy.ply"), path("site"), options);
  const std::vector<SiteMesh> sharp = readSiteMeshes(path("site")).meshes;
  transformFile(path("site"), path("smooth.ply"), "blur(2)", false);
  addOperators(path("site"), "blur(2)");
  const std::vector<SiteMesh> smooth = readSiteMeshes(path("site")).meshes;
  ASSERT_EQ(sharp.size(), 1u);
  ASSERT_EQ(smooth.size(), 1u);
  EXPECT_LT(roughnessOf(smooth[0]), 0.8 * roughnessOf(sharp[0]));
  // A page with the operators, its export and the transformed file are the same surface.
  expectSiteEquals(path("site"), path("smooth.ply"));
  exportSite(path("site"), path("out.ply"));
  EXPECT_EQ(readFile(path("out.ply")), readFile(path("smooth.ply")));
}

TEST(TransformFile, BlursImagesOfASiteAndLeavesNodesOfItsDocumentAsTheyAre) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  std::string points; // too many to stay in the document
  for (int i = 0; i < 100; ++i)
    points += fmt::format("{} 0 {} 0 {} {} {} 1 0 ", i, i % 3, i + 1, i % 5, i + 0.5);
  writeFile(path("in.x3d"), asBytes("<X3D><Scene><Shape><Box/></Shape><Shape><TriangleSet><Coordinate point='" +
                                    points + "'/></TriangleSet></Shape></Scene></X3D>"));
  ConvertOptions options;
  options.encoding = Encoding::classic;
  options.pictures = false;
  convert(path("in.x3d"), path("site"), options);
  const auto meshesOf = [&](const std::string& operators, std::vector<std::string> warnings) {
    const TransformReport report = transformFile(path("site"), path("out.glb"), operators, false);
    EXPECT_EQ(report.written.warnings, warnings) << operators;
    return importFile(path("out.glb")).scene.meshes;
  };
  const std::vector<Mesh> before = meshesOf("translate(0 0 0)", {});
  const std::vector<Mesh> blurred = meshesOf(
      "blur(2) scale(0.5)",
      {"1 geometry is written without operators: blur filters images of coordinates, which it does not have."});
  ASSERT_EQ(before.size(), 2u);
  ASSERT_EQ(blurred.size(), 2u);
  EXPECT_EQ(blurred[0].positions, before[0].positions);
  EXPECT_NE(blurred[1].positions, before[1].positions);

  writeFile(path("in.x3d"), asBytes("<X3D><Scene><Shape><Box/></Shape></Scene></X3D>"));
  EXPECT_EQ(kindOf([&] { transformFile(path("in.x3d"), path("out.glb"), "blur(1)", false); }), ErrorKind::usage);
  options.force = true;
  convert(path("in.x3d"), path("site"), options);
  EXPECT_EQ(kindOf([&] { transformFile(path("site"), path("out.glb"), "blur(1)", false); }), ErrorKind::unsupported);
}

TEST(TransformFile, OfASiteAddsOperatorsToThoseOfItsNodes) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  testing::writeMesh(path("torus.ply"), testing::torus(12, 10));
  convert(path("torus.ply"), path("site"), {});
  transformFile(path("site"), path("both.ply"), "negate(x) scale(0.5)", false);
  addOperators(path("site"), "negate(x)");
  transformFile(path("site"), path("second.ply"), "scale(0.5)", false);
  EXPECT_EQ(readFile(path("both.ply")), readFile(path("second.ply")));
}

TEST(TransformFile, NamesGeometryNodesThatItLeavesOut) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  const std::string texts = "<Shape><Text string='a'/></Shape><Shape><Text string='b'/></Shape>";
  const auto transform = [&](const std::string& shapes) {
    writeFile(path("in.x3d"), asBytes("<X3D><Scene>" + shapes + "</Scene></X3D>"));
    return transformFile(path("in.x3d"), path("out.ply"), "negate(x)", false).written;
  };
  EXPECT_EQ(kindOf([&] { transform(texts); }), ErrorKind::malformed);
  const ExportReport report = transform(
      texts + "<Shape><Box/></Shape><Shape><TriangleSet><Coordinate point='0 0 0 1 0 0 0 1 0'/></TriangleSet></Shape>");
  EXPECT_EQ(report.shapes, 2u);
  EXPECT_EQ(report.elements.triangles, 13u);
  EXPECT_EQ(report.geometryLeftOut, (std::map<std::string, std::size_t>{{"Text", 2}}));
}

TEST(TransformFile, RefusesWithOneSentence) {
  const TemporaryDirectory directory;
  const auto path = [&](const std::string& name) { return directory.path() / name; };
  testing::writeMesh(path("torus.ply"), testing::torus(12, 10));
  convert(path("torus.ply"), path("site"), {});
  const auto transform = [&](const char* input, const char* output, const char* operators) {
    return kindOf([&] { transformFile(path(input), path(output), operators, false); });
  };
  EXPECT_EQ(transform("torus.ply", "out.fbx", "negate()"), ErrorKind::usage);
  EXPECT_EQ(transform("torus.ply", "out.ply", "rotate(1)"), ErrorKind::usage);
  EXPECT_EQ(transform("torus.ply", "out.ply", " "), ErrorKind::usage);
  EXPECT_EQ(transform("torus.ply", "out.ply", "blur(1)"), ErrorKind::usage);
  EXPECT_EQ(transform("site", "out.ply", "blur(1)"), ErrorKind::unsupported);
  EXPECT_EQ(transform("torus.ply", "out.ply", "scale(1e6) scale(1e6)"), ErrorKind::usage);
  EXPECT_EQ(transform("none.ply", "out.ply", "negate()"), ErrorKind::io);
  EXPECT_FALSE(std::filesystem::exists(path("out.ply")));
}

} // namespace
} // namespace imgeo
