// Sequences of every kind of source: what convert writes is what verify reads, and what pages display.

#include "base/error.h"
#include "base/file.h"
#include "base/testing.h"
#include "export/export.h"
#include "imgeo/imgeo.h"
#include "import/import.h"
#include "scene/testing.h"
#include "transcode/export/export_site.h"
#include "transcode/site/sequences.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

constexpr std::size_t frameCount = 5;

/// A mesh at a moment: its points sway, each another way.
Mesh swayed(Mesh mesh, std::size_t frame) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const float phase = 0.5F * static_cast<float>(frame) + 0.7F * static_cast<float>(i);
    mesh.positions[i] = mesh.positions[i] + Vec3f{0.2F * std::sin(phase), 0.1F * std::cos(phase), 0.05F * phase};
  }
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    const Vec3d normal{std::sin(0.3 * static_cast<double>(i + frame)), 1, std::cos(static_cast<double>(i * frame))};
    mesh.normals[i] = Vec3f(normal * (1 / length(normal)));
  }
  for (std::size_t i = 0; i < mesh.colors.size(); ++i)
    mesh.colors[i] = Rgba(float((17 * i + 31 * frame) % 256) / 255, float(frame) / 10, 0, 1);
  for (NamedAttribute& attribute : mesh.namedAttributes)
    for (std::size_t i = 0; i < attribute.values.size(); ++i)
      attribute.values[i] = 20 + std::sin(static_cast<float>(i + frame));
  return mesh;
}

/// Writes frames of a mesh as NAME-0.EXTENSION ...
std::vector<fs::path> writeFrames(const fs::path& folder, const Mesh& mesh, const char* extension) {
  std::vector<fs::path> files;
  for (std::size_t frame = 0; frame < frameCount; ++frame) {
    files.push_back(folder / fmt::format("frame-{}.{}", frame, extension));
    writeFile(files.back(), exportScene(testing::sceneOf({swayed(mesh, frame)}), *meshFormatOf(files.back())));
  }
  return files;
}

void expectEqual(const VerifyReport& report) {
  EXPECT_TRUE(report.equal) << ::testing::PrintToString(report.findings);
  EXPECT_EQ(report.frames, frameCount);
  EXPECT_LE(report.positionError, report.positionBound * 1.000001);
}

/// Converts frames and expects that the site has them; returns the layout of the frames.
live::FrameLayout layoutOfSequence(const Mesh& mesh, const char* extension, ConvertOptions options = {}) {
  SCOPED_TRACE(extension);
  options.pictures = false;
  options.effort = 0;
  const TemporaryDirectory directory;
  const std::vector<fs::path> files = writeFrames(directory.path(), mesh, extension);
  const ConvertReport report = convertSequence(files, directory / "site", options);
  EXPECT_EQ(report.frames, frameCount);
  expectEqual(verifySequence(directory / "site", files));
  return sequencesOf(openDocument(directory / "site")).at(0).index.description.layout;
}

Mesh withNormals(Mesh mesh) {
  mesh.normals.assign(mesh.wedgeCount(), {0, 0, 1});
  return mesh;
}

Mesh withColors(Mesh mesh) {
  mesh.colors.assign(mesh.wedgeCount(), Rgba(1, 1, 1, 1));
  return mesh;
}

Mesh withValues(Mesh mesh, const std::string& name = "temperature") {
  mesh.namedAttributes.push_back({name, 1, std::vector<float>(mesh.wedgeCount())});
  return mesh;
}

TEST(Sequences, OfMeshFilesHaveTheFramesOfTheirFiles) {
  for (const char* extension : {"ply", "obj", "glb"}) {
    EXPECT_EQ(layoutOfSequence(testing::grid(6), extension).normalBits, 0u);
    const live::FrameLayout normals = layoutOfSequence(withNormals(testing::grid(5)), extension, {.positionBits = 20});
    EXPECT_EQ(normals.normalBits, 8u);
    EXPECT_EQ(normals.positionBits, 20u);
    EXPECT_EQ(layoutOfSequence(withColors(withNormals(testing::torus(5, 5))), extension).colorComponents, 3u);
  }
  for (const char* extension : {"ply", "glb"})
    EXPECT_EQ(layoutOfSequence(withColors(testing::pointCloud(90, 1)), extension).vertices, 90u);
}

TEST(Sequences, HaveTheValuesOfAnAttributeThatChanges) {
  ConvertOptions options;
  options.keepAttributes.all = true;
  for (const char* extension : {"ply", "glb"}) {
    const live::FrameLayout layout = layoutOfSequence(withValues(withColors(testing::grid(5))), extension, options);
    EXPECT_EQ(layout.valueComponents, 1u);
    EXPECT_EQ(layout.valueBits, 16u);
  }
  options.attributeBits = 24;
  EXPECT_EQ(layoutOfSequence(withValues(testing::pointCloud(50, 2)), "ply", options).valueBits, 24u);

  const TemporaryDirectory directory;
  const std::vector<fs::path> files =
      writeFrames(directory.path(), withValues(withValues(testing::grid(3)), "pressure"), "ply");
  convertSequence(files, directory / "site", {.keepAttributes = {.names = {"pressure"}}});
  const SiteSequence sequence = sequencesOf(openDocument(directory / "site")).at(0);
  EXPECT_EQ(sequence.index.valueName, "pressure");
  EXPECT_NEAR(sequence.index.description.valueRange.at(0)[0], 19, 0.01);
  EXPECT_NEAR(sequence.index.description.valueRange.at(0)[1], 21, 0.01);
  expectEqual(verifySequence(directory / "site", files));
  EXPECT_THROW(convertSequence(files, directory / "both", options), Error);
}

/// The sentence with which a conversion ends, without the directory.
std::string refusalOf(const std::vector<fs::path>& files, const fs::path& folder) {
  try {
    convertSequence(files, folder / "site", {});
  } catch (const Error& error) {
    EXPECT_FALSE(fs::exists(folder / "site"));
    return fmt::format("{}: {}", fs::path(error.location()).filename().string(), error.message());
  }
  return "";
}

TEST(Sequences, OfFramesThatDoNotFitAreRefusedWithOneSentence) {
  const TemporaryDirectory directory;
  const std::vector<fs::path> files = writeFrames(directory.path(), testing::grid(3), "ply");
  const auto refusalWith = [&](const Bytes& bytes) {
    const Bytes before = readFile(files[4]);
    writeFile(files[4], bytes);
    const std::string refusal = refusalOf(files, directory.path());
    writeFile(files[4], before);
    return refusal;
  };
  const Bytes whole = readFile(files[4]);
  const std::string unlike = fmt::format(
      ", unlike {}: frames of a sequence differ in positions, normals, colours and values only", files[0].string());
  EXPECT_EQ(refusalWith(writePly(testing::sceneOf({testing::grid(4)}))),
            "frame-4.ply: has 25 vertices instead of 16" + unlike);
  Mesh flipped = testing::grid(3);
  std::swap(flipped.corners[0], flipped.corners[25]);
  EXPECT_EQ(refusalWith(writePly(testing::sceneOf({flipped}))),
            "frame-4.ply: joins its vertices to other triangles" + unlike);
  EXPECT_EQ(refusalWith(writePly(testing::sceneOf({withColors(testing::grid(3))}))),
            "frame-4.ply: has colours" + unlike);
  const std::string cut = refusalWith(Bytes(whole.begin(), whole.end() - 40));
  EXPECT_TRUE(cut.starts_with("frame-4.ply")) << cut;
  Bytes strange = whole;
  const float notANumber = std::nanf("");
  std::memcpy(strange.data() + asText(whole).find("end_header\n") + 11, &notANumber, 4);
  EXPECT_TRUE(refusalWith(strange).starts_with("frame-4.ply"));
  fs::remove(files[4]);
  EXPECT_TRUE(refusalOf(files, directory.path()).starts_with("frame-4.ply"));
}

/// Gives a shape `targets` morph targets, of which an animation shows one after the other.
void addTargets(Scene& scene, std::size_t shape, std::size_t sensor, std::size_t targets) {
  SceneGraph& graph = scene.graph;
  Mesh& mesh = scene.meshes[shapeOf(graph, shape).mesh];
  for (std::size_t target = 0; target < targets; ++target) {
    std::vector<float> displacements;
    for (std::size_t i = 0; i < mesh.wedgeCount(); ++i)
      displacements.insert(displacements.end(), {0, 0, std::sin(static_cast<float>(i * (target + 1)))});
    mesh.namedAttributes.push_back({displacementName(target), 3, displacements});
    const std::size_t displacer = addNode(graph, {"", Displacer{fmt::format("target{}", target), 0}, {}, ""});
    graph.nodes[shape].children.push_back(displacer);
    Interpolator weight{InterpolatorKind::scalar, {}, {}};
    for (std::size_t key = 0; key <= targets; ++key) {
      weight.keys.push_back(static_cast<float>(key) / static_cast<float>(targets));
      weight.values.push_back(key == target + 1 ? 1.F : 0.F);
    }
    const std::size_t interpolator = addRoot(graph, {fmt::format("weight{}", target), weight, {}, ""});
    graph.routes.push_back({sensor, "fraction_changed", interpolator, "set_fraction"});
    graph.routes.push_back({interpolator, "value_changed", displacer, "set_weight"});
  }
}

/// Meshes with `targets` morph targets each.
Scene morphScene(std::size_t targets, std::vector<Mesh> meshes = {withNormals(testing::grid(4))}) {
  Scene scene = testing::sceneOf(std::move(meshes));
  TimeSensor clock;
  clock.cycleInterval = static_cast<double>(targets) / 24;
  clock.loop = true;
  const std::size_t sensor = addRoot(scene.graph, {"clock", clock, {}, ""});
  for (const std::size_t shape : shapeNodes(scene.graph))
    addTargets(scene, shape, sensor, targets);
  return scene;
}

TEST(Sequences, OfMorphTargetsHaveAFrameForEachKey) {
  const TemporaryDirectory directory;
  const std::size_t targets = 40;
  writeFile(directory / "morph.glb", exportScene(morphScene(targets), MeshFormat::glb));
  ConvertOptions options;
  options.form = MeshForm::sequence;
  options.rate = 24;
  const ConvertReport report = convert(directory / "morph.glb", directory / "site", options);
  EXPECT_EQ(report.frames, targets + 1);
  EXPECT_NEAR(report.frameRate, 24 * double(targets + 1) / double(targets), 1e-3);
  const SiteDocument document = openDocument(directory / "site");
  EXPECT_EQ(countNodes<Displacer>(document.scene.graph), 0u);
  EXPECT_EQ(countNodes<Interpolator>(document.scene.graph), 1u);
  EXPECT_EQ(document.scene.graph.routes.size(), 1u);
  const VerifyReport verified = verify(directory / "site", directory / "morph.glb");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.frames, targets + 1);

  // Frame n is the n-th target at full weight.
  for (const std::size_t frame : {std::size_t{0}, std::size_t{17}, targets}) {
    exportFrame(directory / "site", static_cast<std::uint32_t>(frame), directory / "frame.ply");
    const Mesh mesh = importFile(directory / "frame.ply").scene.meshes.at(0);
    double largest = 0;
    for (const Vec3f& position : mesh.positions)
      largest = std::max(largest, double{std::abs(position.z)});
    EXPECT_EQ(largest > 0.5, frame > 0) << frame;
  }
}

TEST(Sequences, OfSeveralShapesAreExportedTogether) {
  const TemporaryDirectory directory;
  const std::size_t targets = 6;
  const Scene scene = morphScene(targets, {withNormals(testing::grid(4)), withNormals(testing::grid(2))});
  writeFile(directory / "two.glb", exportScene(scene, MeshFormat::glb));
  ConvertOptions options;
  options.form = MeshForm::video;
  options.rate = 24;
  EXPECT_EQ(convert(directory / "two.glb", directory / "site", options).frames, 2 * (targets + 1));
  const std::vector<SiteSequence> sequences = sequencesOf(openDocument(directory / "site"));
  ASSERT_EQ(sequences.size(), 2u);
  EXPECT_FALSE(sequences[0].video.empty() || sequences[1].video.empty());
  const VerifyReport verified = verify(directory / "site", directory / "two.glb");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  EXPECT_EQ(verified.frames, 2 * (targets + 1));
  EXPECT_LE(verified.positionError, verified.positionBound * 1.000001);
  EXPECT_EQ(frameCountOf(directory / "site"), targets + 1);
  exportFrame(directory / "site", 3, directory / "frame.glb");
  const Scene frame = importFile(directory / "frame.glb").scene;
  ASSERT_EQ(frame.meshes.size(), 2u);
  for (const Mesh& mesh : frame.meshes)
    EXPECT_TRUE(std::ranges::any_of(mesh.positions, [](const Vec3f& p) { return std::abs(p.z) > 0.5; }));
}

/// A mesh whose only joint moves by 3 along z in a second.
Scene skinScene() {
  Scene scene = testing::sceneOf({withNormals(testing::grid(4))});
  SceneGraph& graph = scene.graph;
  const std::size_t shape = shapeNodes(graph).at(0);
  Mesh& mesh = scene.meshes.at(0);
  const std::vector<float> joints(4 * mesh.wedgeCount());
  std::vector<float> weights(4 * mesh.wedgeCount());
  for (std::size_t i = 0; i < weights.size(); i += 4)
    weights[i] = 1;
  mesh.namedAttributes.push_back({jointsName(0), 4, joints});
  mesh.namedAttributes.push_back({jointWeightsName(0), 4, weights});
  Transform transform;
  transform.isJoint = true;
  std::erase(graph.roots, shape);
  const std::size_t joint = addRoot(graph, {"joint", transform, {}, ""});
  addRoot(graph, {"skin", Humanoid{{joint}, {Affine3d{}}}, {shape}, ""});
  const std::size_t sensor = addRoot(graph, {"clock", TimeSensor{}, {}, ""});
  const std::size_t way =
      addRoot(graph, {"way", Interpolator{InterpolatorKind::position, {0, 1}, {0, 0, 0, 0, 0, 3}}, {}, ""});
  graph.routes.push_back({sensor, "fraction_changed", way, "set_fraction"});
  graph.routes.push_back({way, "value_changed", joint, "translation"});
  return scene;
}

TEST(Sequences, OfSkinsHaveTheVerticesAsTheJointsMoveThem) {
  const TemporaryDirectory directory;
  writeFile(directory / "skin.glb", exportScene(skinScene(), MeshFormat::glb));
  ConvertOptions options;
  options.form = MeshForm::sequence;
  options.rate = 4;
  EXPECT_EQ(convert(directory / "skin.glb", directory / "site", options).frames, 5u);
  const SceneGraph graph = openDocument(directory / "site").scene.graph;
  EXPECT_EQ(countNodes<Humanoid>(graph), 0u);
  EXPECT_EQ(countNodes<Interpolator>(graph), 2u) << "those of the frames and of the joint, which stays";
  const VerifyReport verified = verify(directory / "site", directory / "skin.glb");
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);

  const auto positionsOf = [&](std::uint32_t frame) {
    exportFrame(directory / "site", frame, directory / "frame.ply");
    return importFile(directory / "frame.ply").scene.meshes.at(0).positions;
  };
  const std::vector<Vec3f> rest = positionsOf(0), moved = positionsOf(3);
  ASSERT_EQ(rest.size(), moved.size());
  for (std::size_t i = 0; i < rest.size(); ++i)
    EXPECT_LT(length(Vec3d(moved[i]) - Vec3d(rest[i]) - Vec3d{0, 0, 2.25}), 1e-3) << i;
}

TEST(Sequences, AreRefusedWhereNothingMoves) {
  const TemporaryDirectory directory;
  writeFile(directory / "still.glb", exportScene(testing::sceneOf({testing::grid(2)}), MeshFormat::glb));
  ConvertOptions options;
  options.form = MeshForm::sequence;
  EXPECT_THROW(convert(directory / "still.glb", directory / "site", options), Error);
  options.target = Target::x3dom;
  EXPECT_THROW(convert(directory / "still.glb", directory / "site", options), Error);
}

TEST(Sequences, OfFilesFarFromZeroHaveTheOriginOfTheFirstFrame) {
  const TemporaryDirectory directory;
  std::vector<fs::path> files;
  for (int frame = 0; frame < 3; ++frame) {
    files.push_back(directory / fmt::format("frame-{}.obj", frame));
    std::string text;
    for (const Vec3d& p : {Vec3d{0, 0, 0}, Vec3d{2.5, 0, 1}, Vec3d{0, 3.25, 2}})
      text += fmt::format("v {} {} {}\n", 450000.25 + p.x + 1.5 * frame, 5400000.5 + p.y, p.z);
    writeFile(files.back(), asBytes(text + "f 1 2 3\n"));
  }
  convertSequence(files, directory / "site", {});
  const VerifyReport verified = verifySequence(directory / "site", files);
  EXPECT_TRUE(verified.equal) << ::testing::PrintToString(verified.findings);
  const auto smallestOf = [&](std::uint32_t frame) {
    exportFrame(directory / "site", frame, directory / "frame.ply");
    const Mesh mesh = importFile(directory / "frame.ply").scene.meshes.at(0);
    Box3d box;
    for (const Vec3f& position : mesh.positions)
      box.add(Vec3d(position));
    return box.min.x;
  };
  EXPECT_NEAR(smallestOf(0), 0.25, 1e-3);
  EXPECT_NEAR(smallestOf(2), 3.25, 1e-3);
}

} // namespace
} // namespace imgeo
