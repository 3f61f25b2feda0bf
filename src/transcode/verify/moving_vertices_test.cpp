// Coordinates and normals that interpolators of a document move become sequences, and sequences of a site those of
// another.

#include "base/file.h"
#include "base/testing.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "transcode/export/export_site.h"
#include "transcode/site/sequences.h"

#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

/// A document with a cloth of quadrilaterals that an interpolator moves.
struct ClothDocument {
  std::size_t edge = 5, keys = 7;
  std::string fields = "creaseAngle='4'"; ///< of the IndexedFaceSet
  std::string cycle = "0.2";              ///< of the TimeSensor: 30 intervals a second with 7 keys
  std::string further = "";               ///< nodes and routes
  bool hasNormals = false;

  float height(std::size_t point, std::size_t key) const {
    return std::sin(static_cast<float>(point) + static_cast<float>(key * key));
  }

  Vec3f normal(std::size_t point, std::size_t key) const {
    const Vec3d sum{0.3 * height(point, key), 0.5 * height(point + 1, key), 1};
    return Vec3f(sum * (1 / length(sum)));
  }

  std::string text() const {
    std::string keyText, values, normals, index;
    for (std::size_t key = 0; key < keys; ++key) {
      keyText += fmt::format("{:.5f} ", static_cast<double>(key) / static_cast<double>(keys - 1));
      for (std::size_t point = 0; point < edge * edge; ++point) {
        values += fmt::format("{} {} {} ", point % edge, point / edge, height(point, key));
        const Vec3f direction = normal(point, key);
        normals += fmt::format("{} {} {} ", direction.x, direction.y, direction.z);
      }
    }
    for (std::size_t y = 0; y + 1 < edge; ++y)
      for (std::size_t x = 0; x + 1 < edge; ++x)
        index +=
            fmt::format("{} {} {} {} -1 ", y * edge + x, y * edge + x + 1, (y + 1) * edge + x + 1, (y + 1) * edge + x);
    const std::string normalNodes =
        hasNormals
            ? fmt::format("<NormalInterpolator DEF='Turn' key='{}' keyValue='{}'/>"
                          "<ROUTE fromNode='Clock' fromField='fraction_changed' toNode='Turn' toField='set_fraction'/>"
                          "<ROUTE fromNode='Turn' fromField='value_changed' toNode='Normals' toField='set_vector'/>",
                          keyText, normals)
            : "";
    return fmt::format(
        "<X3D><Scene><TimeSensor DEF='Clock' cycleInterval='{}' loop='true'/>"
        "<CoordinateInterpolator DEF='Wave' key='{}' keyValue='{}'/>"
        "<Shape DEF='Cloth'><IndexedFaceSet solid='false' {} coordIndex='{}'>"
        "<Coordinate DEF='Points' point='0 0 0'/>{}</IndexedFaceSet></Shape>{}"
        "<ROUTE fromNode='Clock' fromField='fraction_changed' toNode='Wave' toField='set_fraction'/>"
        "<ROUTE fromNode='Wave' fromField='value_changed' toNode='Points' toField='set_point'/>{}</Scene></X3D>",
        cycle, keyText, values, fields, index, hasNormals ? "<Normal DEF='Normals' vector='0 0 1'/>" : "", further,
        normalNodes);
  }
};

ConvertOptions quick(MeshForm form) {
  ConvertOptions options;
  options.form = form;
  options.effort = 0;
  options.pictures = false;
  return options;
}

/// Converts a document and expects that verify finds what was converted.
ConvertReport convertText(const std::string& text, const fs::path& folder, MeshForm form) {
  writeFile(folder / "scene.x3d", asBytes(text));
  const ConvertReport report = convert(folder / "scene.x3d", folder / "site", quick(form));
  const VerifyReport verified = verify(folder / "site", folder / "scene.x3d");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.frames, report.frames);
  return report;
}

Mesh frameOf(const fs::path& site, std::size_t frame) {
  exportFrame(site, static_cast<std::uint32_t>(frame), site.parent_path() / "frame.ply");
  return importFile(site.parent_path() / "frame.ply").scene.meshes.at(0);
}

const Interpolator& framesIn(const SceneGraph& graph) {
  for (const Node& node : graph.nodes)
    if (hasFrames(node))
      return std::get<Interpolator>(node.content);
  throw std::runtime_error("there are no frames");
}

TEST(MovingVertices, OfAnInterpolatorAreASequenceWhoseFramesAreItsKeys) {
  const TemporaryDirectory directory;
  const ClothDocument cloth;
  const ConvertReport report = convertText(cloth.text(), directory.path(), MeshForm::sequence);
  EXPECT_EQ(report.frames, cloth.keys);
  EXPECT_TRUE(report.warnings.empty()) << ::testing::PrintToString(report.warnings);

  const SiteDocument document = openDocument(directory / "site");
  const SceneGraph& graph = document.scene.graph;
  ASSERT_EQ(graph.routes.size(), 1u);
  EXPECT_EQ(graph.nodes[graph.routes[0].fromNode].name, "Clock");
  EXPECT_EQ(graph.nodes[graph.routes[0].toNode].name, "Wave");
  EXPECT_TRUE(hasFrames(graph.nodes[graph.routes[0].toNode]));
  EXPECT_EQ(countNodes<Interpolator>(graph), 1u);
  const SiteSequence sequence = sequencesOf(document).at(0);
  EXPECT_EQ(sequence.index.description.layout.columns, cloth.edge);
  EXPECT_EQ(sequence.index.description.layout.normalBits, 0u);
  const double bound = sequence.index.description.step() / 2 * 1.001;
  for (std::size_t key = 0; key < cloth.keys; ++key) {
    const Mesh mesh = frameOf(directory / "site", key);
    ASSERT_EQ(mesh.positions.size(), cloth.edge * cloth.edge);
    for (const Vec3f& position : mesh.positions) {
      const auto point = static_cast<std::size_t>(std::lround(position.x) + std::lround(position.y) * long(cloth.edge));
      EXPECT_NEAR(position.z, cloth.height(point, key), bound) << key;
    }
  }
}

TEST(MovingVertices, BecomeASequenceByThemselvesWhereTheTextIsLong) {
  const TemporaryDirectory directory;
  ClothDocument cloth{.edge = 20, .keys = 31, .cycle = "1"};
  EXPECT_EQ(convertText(cloth.text(), directory.path(), MeshForm::mesh).frames, 31u);
  // A few keys that are far apart take more bytes as frames.
  cloth.cycle = "5";
  EXPECT_EQ(convertText(cloth.text(), directory.path(), MeshForm::mesh).frames, 0u);
  EXPECT_EQ(convertText(cloth.text(), directory.path(), MeshForm::sequence).frames, 151u);
  // Short text stays as it is, and X3DOM plays text only.
  cloth = {};
  EXPECT_EQ(convertText(cloth.text(), directory.path(), MeshForm::mesh).frames, 0u);
  cloth = {.edge = 20, .keys = 31, .cycle = "1"};
  writeFile(directory / "scene.x3d", asBytes(cloth.text()));
  ConvertOptions options = quick(MeshForm::mesh);
  options.target = Target::x3dom;
  EXPECT_EQ(convert(directory / "scene.x3d", directory / "site", options).frames, 0u);
}

TEST(MovingVertices, HaveTheNormalsThatAnotherInterpolatorTurns) {
  const TemporaryDirectory directory;
  ClothDocument cloth;
  cloth.hasNormals = true;
  convertText(cloth.text(), directory.path(), MeshForm::sequence);
  const SceneGraph graph = openDocument(directory / "site").scene.graph;
  EXPECT_EQ(graph.routes.size(), 1u);
  EXPECT_EQ(countNodes<Interpolator>(graph), 1u);
  for (std::size_t key = 0; key < cloth.keys; ++key) {
    const Mesh mesh = frameOf(directory / "site", key);
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
      const Vec3f position = mesh.positions[mesh.wedgePositions[wedge]];
      const auto point = static_cast<std::size_t>(std::lround(position.x) + std::lround(position.y) * long(cloth.edge));
      EXPECT_GT(dot(Vec3d(mesh.normals.at(wedge)), Vec3d(cloth.normal(point, key))), 0.9998) << key;
    }
  }
}

TEST(MovingVertices, HaveFlatNormalsWhereCreasesAreSharp) {
  const TemporaryDirectory directory;
  const ClothDocument cloth{.fields = "creaseAngle='0'"};
  convertText(cloth.text(), directory.path(), MeshForm::sequence);
  const std::size_t key = 3;
  const Mesh mesh = frameOf(directory / "site", key);
  ASSERT_FALSE(mesh.corners.empty());
  for (std::size_t corner = 0; corner < mesh.corners.size(); corner += 3) {
    Vec3d middle;
    for (std::size_t i = 0; i < 3; ++i)
      middle = middle + Vec3d(mesh.positions[mesh.wedgePositions[mesh.corners[corner + i]]]) * (1.0 / 3);
    const auto point = [&](int x, int y) {
      const std::size_t column = std::size_t(middle.x) + std::size_t(x), row = std::size_t(middle.y) + std::size_t(y);
      return Vec3d{double(column), double(row), cloth.height(row * cloth.edge + column, key)};
    };
    const Vec3d normal = cross(point(1, 1) - point(0, 0), point(0, 1) - point(1, 0)); // Newell's, of the quadrilateral
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_GT(dot(normal, Vec3d(mesh.normals.at(mesh.corners[corner + i]))), 0.9995 * length(normal)) << corner;
  }
}

TEST(MovingVertices, OfSeveralGeometriesAreASequenceEach) {
  const TemporaryDirectory directory;
  ClothDocument cloth;
  cloth.further = "<Shape><PointSet><Coordinate USE='Points'/></PointSet></Shape><Transform translation='9 0 0'>"
                  "<Shape USE='Cloth'/></Transform>";
  const ConvertReport report = convertText(cloth.text(), directory.path(), MeshForm::sequence);
  EXPECT_EQ(report.frames, 2 * cloth.keys);
  const SiteDocument document = openDocument(directory / "site");
  EXPECT_EQ(sequencesOf(document).size(), 2u);
  EXPECT_EQ(document.scene.graph.routes.size(), 2u);
}

TEST(MovingVertices, StayTextWhereMoreThanAnInterpolatorReachesThem) {
  const TemporaryDirectory directory;
  ClothDocument cloth{.edge = 20, .keys = 31, .cycle = "1"};
  cloth.further = "<Script DEF='S'/><ROUTE fromNode='S' fromField='points' toNode='Points' toField='set_point'/>";
  EXPECT_EQ(convertText(cloth.text(), directory.path(), MeshForm::mesh).frames, 0u);
  writeFile(directory / "scene.x3d", asBytes(cloth.text()));
  EXPECT_THROW(convert(directory / "scene.x3d", directory / "site", quick(MeshForm::sequence)), Error);
}

/// The frames of a site's only sequence.
std::vector<live::Frame> allFrames(const fs::path& site) {
  const SiteDocument document = openDocument(site);
  const SiteSequence sequence = sequencesOf(document).at(0);
  std::vector<live::Frame> frames;
  readFrames(document, sequence, 0, sequence.index.frameCount(),
             [&](const live::Frame& frame) { frames.push_back(frame); });
  return frames;
}

TEST(MovingVertices, OfASiteAreTheSameInAnother) {
  const TemporaryDirectory directory;
  ClothDocument cloth{.edge = 8};
  cloth.hasNormals = true;
  convertText(cloth.text(), directory.path(), MeshForm::video);
  ASSERT_FALSE(framesIn(openDocument(directory / "site").scene.graph).video.empty());
  const std::vector<live::Frame> frames = allFrames(directory / "site");
  ASSERT_EQ(frames.size(), cloth.keys);
  const auto expectSame = [&](const fs::path& from, const fs::path& to, MeshForm form, bool hasVideo) {
    const ConvertReport report = convert(from / "scene.x3d", to, quick(form));
    EXPECT_EQ(report.frames, cloth.keys);
    EXPECT_TRUE(report.warnings.empty()) << ::testing::PrintToString(report.warnings);
    const SceneGraph graph = openDocument(to).scene.graph;
    EXPECT_EQ(!framesIn(graph).video.empty(), hasVideo);
    ASSERT_EQ(graph.routes.size(), 1u);
    EXPECT_EQ(graph.nodes[graph.routes[0].toNode].name, "Wave");
    const VerifyReport verified = verify(to, from / "scene.x3d");
    EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
    EXPECT_EQ(verified.frames, cloth.keys);
    const std::vector<live::Frame> copied = allFrames(to);
    ASSERT_EQ(copied.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i)
      EXPECT_EQ(copied[i].components, frames[i].components) << i;
  };
  expectSame(directory / "site", directory / "kept", MeshForm::mesh, true);
  expectSame(directory / "site", directory / "frames", MeshForm::sequence, false);
  expectSame(directory / "frames", directory / "still frames", MeshForm::mesh, false);
  expectSame(directory / "frames", directory / "video", MeshForm::video, true);
}

} // namespace
} // namespace imgeo
