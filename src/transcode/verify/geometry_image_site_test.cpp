// Converts meshes to geometry images and reads the sites back.

#include "base/error.h"
#include "containers/png/png.h"
#include "prepare/half_edges.h"
#include "scene/testing.h"
#include "transcode/site/read_meshes.h"
#include "transcode/site/testing.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <initializer_list>
#include <tuple>

namespace imgeo {
namespace {

using testing::TemporaryDirectory;

ConvertOptions geometryImages(std::uint32_t grid) {
  ConvertOptions options;
  options.pictures = false;
  options.form = MeshForm::geometryImage;
  options.grid = grid;
  return options;
}

std::size_t openEdges(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t wedge : mesh.corners)
    corners.push_back(mesh.wedgePositions[wedge]);
  return static_cast<std::size_t>(std::ranges::count(oppositeHalfEdges(corners), noHalfEdge));
}

TEST(GeometryImageSite, StatesHowFarItIsOffAndVerifyMeasuresTheSame) {
  for (const Mesh& mesh : {testing::sphere(12, 20), testing::torus(24, 12), testing::grid(12)}) {
    const TemporaryDirectory directory;
    testing::writeMesh(directory / "input.ply", mesh);
    ConvertOptions options = geometryImages(28);
    options.gridImageEdge = 16; // charts need several images
    const ConvertReport converted = convert(directory / "input.ply", directory / "site", options);
    ASSERT_EQ(converted.resampled.size(), 1u);
    EXPECT_GE(converted.patches, 4u);
    const ResampledMesh& resampled = converted.resampled[0];
    EXPECT_EQ(resampled.geometryImages, converted.patches);
    EXPECT_EQ(resampled.texels, converted.vertices);
    EXPECT_GT(resampled.largestDistance, 0);
    EXPECT_LT(resampled.largestDistance, 0.02 * resampled.diagonal);
    EXPECT_LE(resampled.meanDistance, 0.2 * resampled.largestDistance);

    const VerifyReport verified = verify(directory / "site", directory / "input.ply");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    EXPECT_EQ(verified.resampledMeshes, 1u);
    EXPECT_NEAR(verified.surfaceDistance, resampled.largestDistance, 1e-3 * resampled.largestDistance);
    EXPECT_NEAR(verified.surfaceDistanceBound, resampled.largestDistance, 1e-3 * resampled.largestDistance);

    const SiteInfo info = inspect(directory / "site");
    EXPECT_EQ(info.elements, converted.elements);
    EXPECT_EQ(info.vertices, converted.vertices);
    EXPECT_EQ(info.geometries.at(0).grid, "geometryImage");
    EXPECT_NEAR(info.geometries.at(0).surfaceDistance, resampled.largestDistance, 1e-3 * resampled.largestDistance);
    const bool isOpen = mesh.normals.empty(); // the field of testing::grid
    const SiteDocument document = openDocument(directory / "site");
    EXPECT_EQ(openEdges(readMeshes(document).meshes.at(0)) > 0, isOpen);
    for (const PatchDescription& patch : document.scene.geometries.at(0).patches)
      EXPECT_LE(std::max(patch.implicitMeshSize.x, patch.implicitMeshSize.y), 16u);
  }
}

TEST(GeometryImageSite, IsExportedAsTheMeshOfItsGrids) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::torus(16, 10));
  convert(directory / "input.ply", directory / "site", geometryImages(32));
  exportSite(directory / "site", directory / "out.ply");
  const VerifyReport verified = verify(directory / "site", directory / "input.ply");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  // The exported mesh is nearer to the site than the site to its source.
  EXPECT_LE(verify(directory / "site", directory / "out.ply").surfaceDistance, 1e-4);
}

/// Changes the first byte of a texel, a third down, of the first image that a field of the geometry names.
void damageImage(const TemporaryDirectory& directory, const std::string& field, int change) {
  const std::string page = std::string(asText(readFile(directory / "site" / "index.html")));
  const std::size_t at = page.find(" " + field + "=", page.find("<ImageGeometry"));
  ASSERT_NE(at, std::string::npos) << field;
  const std::size_t begin = page.find_first_not_of("'\"", at + field.size() + 2);
  const std::string url = page.substr(begin, page.find_first_of("#\"'", begin) - begin);
  Image image = decodePng(readFile(directory / "site" / url), url);
  const std::size_t byte = image.pixels.size() / 3 / image.channels * image.channels;
  image.pixels[byte] = static_cast<std::uint8_t>(image.pixels[byte] + (image.pixels[byte] < 128 ? change : -change));
  const Bytes damaged = encodePng(image, 1);
  const std::string name = "geometry/" + contentName(damaged) + ".png"; // names tell damage of files themselves
  writeFile(directory / "site" / name, damaged);
  for (const char* document : {"index.html", "scene.x3d"}) {
    std::string text = std::string(asText(readFile(directory / "site" / document)));
    for (std::size_t found = text.find(url); found != text.npos; found = text.find(url, found + name.size()))
      text.replace(found, url.size(), name);
    writeFile(directory / "site" / document, asBytes(text));
  }
}

void replaceInPage(const TemporaryDirectory& directory, const std::string& what, const std::string& by) {
  for (const char* name : {"index.html", "scene.x3d"}) {
    std::string page = std::string(asText(readFile(directory / "site" / name)));
    const std::size_t at = page.find(what);
    ASSERT_NE(at, std::string::npos);
    page.replace(at, page.find('"', at + what.size()) - at, what + by);
    writeFile(directory / "site" / name, asBytes(page));
  }
}

TEST(GeometryImageSite, ThatIsFartherOffThanItStatesIsNotEqual) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(12, 20));
  const auto findingsAfter = [&](const std::function<void()>& damage) {
    convert(directory / "input.ply", directory / "site", geometryImages(32));
    damage();
    const VerifyReport verified = verify(directory / "site", directory / "input.ply");
    EXPECT_FALSE(verified.equal);
    return fmt::format("{}", ::testing::PrintToString(verified.findings));
  };
  EXPECT_NE(findingsAfter([&] { damageImage(directory, "coord", 60); }).find("A surface is off by"), std::string::npos);
  EXPECT_NE(findingsAfter([&] {
              replaceInPage(directory, "surfaceDistance=\"", "0.0001 0.00001");
            }).find("more than the 0.0001 that the site states"),
            std::string::npos);
}

/// A torus with all attributes, whose colours change from vertex to vertex.
Mesh coloredTorus() {
  Mesh mesh = testing::torus(24, 12);
  testing::Random random(3);
  while (mesh.colors.size() < mesh.wedgeCount())
    mesh.colors.emplace_back(random.color());
  return mesh;
}

TEST(GeometryImageSite, HasTheAttributesThatItsSourceHasAtItsVertices) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", coloredTorus());
  for (const std::uint32_t bits : {12u, 16u, 24u}) {
    ConvertOptions options = geometryImages(40);
    options.positionBits = bits;
    convert(directory / "input.ply", directory / "site", options);
    const VerifyReport verified = verify(directory / "site", directory / "input.ply");
    EXPECT_TRUE(verified.equal) << bits << ::testing::PrintToString(verified.findings);
    EXPECT_GT(verified.normalErrorDegrees, 0);
    EXPECT_GT(verified.normalBoundDegrees, verified.normalErrorDegrees);
    EXPECT_GT(verified.attributeError, 0.5);
    EXPECT_LE(verified.attributeError, 1);
  }
}

TEST(GeometryImageSite, WithOneDamagedVertexIsNotEqual) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", coloredTorus());
  // An image of texture coordinates has their high bytes in its first two channels.
  for (const auto& [field, change, finding] : std::initializer_list<std::tuple<const char*, int, const char*>>{
           {"coord", 1, "1 of "},
           {"normal", 3, "Normals are off by up to"},
           {"texCoord", 1, "Texture coordinates are off by up to"},
           {"color", 3, "1 of "}}) {
    convert(directory / "input.ply", directory / "site", geometryImages(40));
    damageImage(directory, field, change);
    const VerifyReport verified = verify(directory / "site", directory / "input.ply");
    EXPECT_FALSE(verified.equal) << field;
    EXPECT_TRUE(
        std::ranges::any_of(verified.findings, [&](const std::string& each) { return each.find(finding) == 0; }))
        << field << ::testing::PrintToString(verified.findings);
  }
}

TEST(GeometryImageSite, KeepsTheStatedMaximumError) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(12, 20));
  std::size_t texels = 0;
  for (const double percent : {2.0, 0.5}) {
    ConvertOptions options = geometryImages(0);
    options.maxError = MaxError{percent, true};
    const ConvertReport converted = convert(directory / "input.ply", directory / "site", options);
    EXPECT_LE(converted.resampled.at(0).largestDistance, 2 * percent / 100);
    EXPECT_GT(converted.resampled[0].texels, texels);
    texels = converted.resampled[0].texels;
    EXPECT_TRUE(verify(directory / "site", directory / "input.ply").equal);
  }
}

TEST(GeometryImageSite, HasOtherShapesAsMeshes) {
  const TemporaryDirectory directory;
  writeFile(directory / "input.obj", asBytes(std::string("v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3\nf 1 2 3\n")));
  const ConvertReport converted = convert(directory / "input.obj", directory / "site", geometryImages(8));
  EXPECT_EQ(converted.elements.lines, 2u);
  EXPECT_EQ(converted.resampled.size(), 1u);
  const VerifyReport verified = verify(directory / "site", directory / "input.obj");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
}

TEST(GeometryImageSite, RefusesOptionsThatItCannotKeep) {
  const TemporaryDirectory directory;
  testing::writeMesh(directory / "input.ply", testing::sphere(4, 6));
  const auto refusal = [&](const std::function<void(ConvertOptions&)>& change) {
    ConvertOptions options = geometryImages(32);
    change(options);
    try {
      convert(directory / "input.ply", directory / "site", options);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal([](ConvertOptions& options) { options.encoding = Encoding::bg; }),
            "--as: geometry images are stored in sig, profile classic");
  EXPECT_EQ(refusal([](ConvertOptions& options) { options.target = Target::x3dom; }),
            "--as: X3DOM draws no geometry images");
  EXPECT_EQ(refusal([](ConvertOptions& options) {
              options.maxError = MaxError{1, true};
            }),
            "--max-error: chooses the grid that --grid states");
  EXPECT_EQ(refusal([](ConvertOptions& options) { options.form = MeshForm::mesh; }),
            "--grid: is the resolution of geometry images: --as geometry-image");
  EXPECT_NE(refusal([](ConvertOptions& options) {
              options.grid = 0;
              options.maxError = MaxError{1e-9, false};
            }).find("--max-error"),
            std::string::npos);
}

} // namespace
} // namespace imgeo
