#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

constexpr std::size_t shapeCount = 2'100;

/// An OBJ file of quadrilaterals of 20 sizes on a grid, no two alike.
std::string quadrilaterals() {
  std::string text;
  for (std::size_t n = 0; n < shapeCount; ++n) {
    const double x = 3.0 * static_cast<double>(n % 50), z = 3.0 * static_cast<double>(n / 50),
                 size = 0.1 * static_cast<double>(1 + n % 20), y = 0.0007 * static_cast<double>(n % 977);
    text += fmt::format("o part{}\nv {:.4f} {:.4f} {:.4f}\nv {:.4f} 0 {:.4f}\nv {:.4f} 0.5 {:.4f}\nv {:.4f} 0 {:.4f}\n"
                        "f {} {} {} {}\n",
                        n, x, y, z, x + size, z, x + size, z + size, x, z + size + y, 4 * n + 1, 4 * n + 4, 4 * n + 3,
                        4 * n + 2);
  }
  return text;
}

class TinyShapes : public ::testing::Test {
protected:
  /// Converts once: the tests change copies of the site.
  static void SetUpTestSuite() {
    original = std::make_unique<TemporaryDirectory>();
    writeFile(*original / "in.obj", asBytes(quadrilaterals()));
    ConvertOptions options;
    options.pictures = false;
    convert(*original / "in.obj", *original / "site", options);
  }
  static void TearDownTestSuite() { original.reset(); }

  TinyShapes() { std::filesystem::copy(original->path(), directory.path(), std::filesystem::copy_options::recursive); }

  std::string page() const {
    const Bytes bytes = readFile(directory / "site" / "index.html");
    return {bytes.begin(), bytes.end()};
  }

  static inline std::unique_ptr<TemporaryDirectory> original;
  TemporaryDirectory directory;
};

TEST_F(TinyShapes, TakeAPageSmallerThanTheirSourceAndAreElementsOfTheirOwn) {
  const std::string html = page();
  std::size_t bytes = 0, shapes = 0;
  for (const auto& file : std::filesystem::directory_iterator(directory / "site" / "geometry"))
    bytes += file.file_size();
  EXPECT_LT(bytes, 40 * shapeCount);
  EXPECT_LT(html.size(), std::filesystem::file_size(directory / "in.obj"));
  for (std::size_t at = html.find("<Shape DEF=\"part"); at != std::string::npos;
       at = html.find("<Shape DEF=\"part", at + 1))
    ++shapes;
  EXPECT_EQ(shapes, shapeCount);
  EXPECT_LT(std::ranges::count(html, '#'), static_cast<std::ptrdiff_t>(shapeCount + 100));
}

TEST_F(TinyShapes, EqualTheirSourceAndAreExported) {
  const VerifyReport verified = verify(directory / "site", directory / "in.obj");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.site.triangles, 2 * shapeCount);
  EXPECT_EQ(inspect(directory / "site").patches, shapeCount);
  exportSite(directory / "site", directory / "out.glb");
  const VerifyReport exported = verify(directory / "site", directory / "out.glb"); // whose materials are glTF's
  EXPECT_EQ(exported.input.triangles, 2 * shapeCount);
  EXPECT_EQ(exported.missing.triangles + exported.extra.triangles, 0u);
}

TEST_F(TinyShapes, AreConvertedAgainFromTheirPage) {
  ConvertOptions options;
  options.pictures = false;
  options.strict = true;
  const ConvertReport report = convert(directory / "site/index.html", directory / "new", options);
  EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
  EXPECT_EQ(report.elements.triangles, 2 * shapeCount);
  EXPECT_EQ(inspect(directory / "new").patches, shapeCount);
  const VerifyReport verified = verify(directory / "new", directory / "site/index.html");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.site.triangles, 2 * shapeCount);
}

TEST_F(TinyShapes, AreConvertedWithoutTheGeometryThatTheirPageNamesInVain) {
  std::string html = page();
  const auto rename = [&](std::string_view name) { // the next patch="g..."
    const std::size_t begin = html.find("patch=\"g") + 7;
    html.replace(begin, html.find('"', begin) - begin, name);
  };
  const std::size_t begin = html.find("patch=\"g") + 7;
  const std::string beyond = html.substr(begin, html.find('#', begin) - begin) + "#99999";
  rename("no g#1");
  rename("17");
  rename("part0#0"); // is a Shape
  writeFile(directory / "site/index.html", asBytes(html));
  ConvertOptions options;
  options.pictures = false;
  ConvertReport report = convert(directory / "site/index.html", directory / "new", options);
  ASSERT_EQ(report.warnings.size(), 1u) << ::testing::PrintToString(report.warnings);
  EXPECT_TRUE(report.warnings[0].starts_with("3 Shapes left without their geometry, the first at "))
      << report.warnings[0];
  EXPECT_NE(report.warnings[0].find("patch=\"no g#1\" names no patch"), std::string::npos) << report.warnings[0];
  EXPECT_EQ(report.elements.triangles, 2 * (shapeCount - 3));

  rename(beyond);
  writeFile(directory / "site/index.html", asBytes(html));
  report = convert(directory / "site/index.html", directory / "new", options);
  ASSERT_EQ(report.warnings.size(), 2u) << ::testing::PrintToString(report.warnings);
  EXPECT_NE(report.warnings[1].find("has no patch 99999"), std::string::npos) << report.warnings[1];
  options.strict = true;
  try {
    convert(directory / "site/index.html", directory / "strict", options);
    ADD_FAILURE() << "was converted";
  } catch (const Error& error) {
    EXPECT_EQ(exitCode(error.kind()), 3) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(directory / "strict"));
}

TEST_F(TinyShapes, AreRefusedWhereTheirFileIsShorterOrTheirNodeIsUnknown) {
  std::string html = page();
  const std::size_t patch = html.find("patch=\"g");
  ASSERT_NE(patch, std::string::npos);
  for (const char* name : {"patch=\"h", "patch=\"#"}) {
    std::string edited = html;
    edited.replace(patch, std::string_view(name).size(), name);
    writeFile(directory / "site" / "index.html", asBytes(edited));
    EXPECT_THROW(inspect(directory / "site" / "index.html"), Error) << name;
  }
  writeFile(directory / "site" / "index.html", asBytes(html));
  const auto file = std::filesystem::directory_iterator(directory / "site" / "geometry")->path();
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  EXPECT_THROW(exportSite(directory / "site", directory / "out.glb"), Error);
}

TEST(TexturedTinyShapes, ShareFilesWhereEachHasABoxOfTextureCoordinatesOfItsOwn) {
  const TemporaryDirectory directory;
  std::string text;
  for (std::size_t n = 0; n < shapeCount; ++n) {
    const double s = static_cast<double>(n % 50) / 50, t = static_cast<double>(n / 50) / 50;
    text +=
        fmt::format("o part{}\nv {} {} 0\nv {} {} 0\nv {} {} 1\nvt {:.3f} {:.3f}\nvt {:.3f} {:.3f}\nvt {:.3f} {:.3f}\n"
                    "f {}/{} {}/{} {}/{}\n",
                    n, n, n % 7, n + 1, n % 5, n, n % 3, s, t, s + 0.01, t, s, t + 0.015, 3 * n + 1, 3 * n + 1,
                    3 * n + 2, 3 * n + 2, 3 * n + 3, 3 * n + 3);
  }
  writeFile(directory / "in.obj", asBytes(text));
  ConvertOptions options;
  options.pictures = false;
  convert(directory / "in.obj", directory / "site", options);
  const std::filesystem::directory_iterator files(directory / "site" / "geometry");
  EXPECT_LT(std::distance(begin(files), end(files)), 5);
  EXPECT_TRUE(verify(directory / "site", directory / "in.obj").equal);
}

} // namespace
} // namespace imgeo
