#include "import/isolation/child_process.h"

#include "base/error.h"
#include "import/isolation/serialize.h"
#include "scene/testing.h"

#include <csignal>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

Imported sampleImport() {
  Imported imported;
  imported.format = "some";
  imported.warnings = {"one", "two"};
  imported.scene = testing::sceneOf({testing::randomMesh(3), testing::randomMesh(4)});
  imported.scene.meshes[0].namedAttributes.push_back({"heat", 1, {1, 2, 3}});
  imported.scene.meshes[0].creaseDegrees = 45;
  SceneGraph& graph = imported.scene.graph;
  graph.title = "title";
  graph.info = {"info"};
  graph.background = Background{{1, 2, 3}};
  graph.images = {{"a.png", {1, 2, 3}}};
  graph.textures = {
      {"t", 0, Boundary::clamp, Boundary::repeat, Filter::nearest, Filter::linear, Filter::standard, true}};
  graph.appearances = {
      {"red", PhysicalMaterial{.baseColor{1, 0, 0}}, {{TextureRole::normal, 0, {}}}, AlphaMode::mask, 0.25f},
      {"", UnlitMaterial{}, {}, AlphaMode::automatic, 0.5f}};
  Transform transform;
  transform.scale = {1, 2, 3};
  addRoot(graph, {"node", transform, {0, 1}, "{}"});
  addRoot(graph, {"eye", Viewpoint{"door", {1, 2, 3}, {}, 0.5, {}}, {}, ""});
  addRoot(graph, {"plan", OrthoViewpoint{}, {}, ""});
  addRoot(graph, {"", SpotLight{}, {}, ""});
  return imported;
}

void expectEqual(const Imported& a, const Imported& b) {
  EXPECT_EQ(a.format, b.format);
  EXPECT_EQ(a.warnings, b.warnings);
  EXPECT_EQ(a.scene.graph, b.scene.graph);
  ASSERT_EQ(a.scene.meshes.size(), b.scene.meshes.size());
  for (std::size_t i = 0; i < a.scene.meshes.size(); ++i) {
    const Mesh &mesh = a.scene.meshes[i], &other = b.scene.meshes[i];
    EXPECT_EQ(mesh.name, other.name);
    EXPECT_EQ(mesh.topology, other.topology);
    EXPECT_EQ(mesh.positions, other.positions);
    EXPECT_EQ(mesh.wedgePositions, other.wedgePositions);
    EXPECT_EQ(mesh.corners, other.corners);
    EXPECT_EQ(mesh.creaseDegrees, other.creaseDegrees);
    EXPECT_EQ(mesh.normals, other.normals);
    EXPECT_EQ(mesh.texCoords, other.texCoords);
    EXPECT_EQ(mesh.colors, other.colors);
    EXPECT_EQ(mesh.colorComponents, other.colorComponents);
    EXPECT_EQ(mesh.namedAttributes, other.namedAttributes);
  }
}

TEST(Serialization, RestoresEverything) {
  expectEqual(deserialized(serialized(sampleImport())), sampleImport());
  expectEqual(deserialized(serialized({})), {});
}

TEST(Serialization, RefusesEveryTruncation) {
  const Bytes bytes = serialized(sampleImport());
  for (std::size_t length = 0; length < bytes.size(); length += 7)
    EXPECT_THROW(deserialized(ByteSpan(bytes).first(length)), std::out_of_range) << length;
}

Error errorOf(const std::function<Imported()>& read, const ChildProcessLimits& limits = {}) {
  try {
    readInChildProcess(read, "a.fbx", limits);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "was read";
  return {ErrorKind::usage, "", ""};
}

TEST(ReadInChildProcess, ReturnsTheResult) {
  expectEqual(readInChildProcess(sampleImport, "a"), sampleImport());
}

TEST(ReadInChildProcess, RethrowsAnError) {
  const Error error = errorOf([]() -> Imported { throw Error(ErrorKind::unsupported, "b:3", "is odd"); });
  EXPECT_EQ(error.kind(), ErrorKind::unsupported);
  EXPECT_STREQ(error.what(), "b:3: is odd");
}

TEST(ReadInChildProcess, SurvivesACrashOfTheChild) {
  EXPECT_EQ(errorOf([]() -> Imported {
              raise(SIGSEGV);
              return {};
            }).kind(),
            ErrorKind::malformed);
  EXPECT_EQ(errorOf([]() -> Imported { std::abort(); }).kind(), ErrorKind::malformed);
  EXPECT_EQ(errorOf([]() -> Imported { _Exit(0); }).kind(), ErrorKind::malformed);
  EXPECT_EQ(errorOf([]() -> Imported { throw std::runtime_error("bug"); }).kind(), ErrorKind::malformed);
}

TEST(ReadInChildProcess, StopsAChildThatTakesTooLong) {
  const Error error = errorOf(
      []() -> Imported {
        for (volatile unsigned i = 0;;) {
          i = i + 1;
        }
      },
      {.seconds = 1, .memoryBytes = 1u << 30});
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_EQ(error.location(), "a.fbx");
  EXPECT_EQ(error.message(), "reading it took more than 1 seconds");
}

TEST(ReadInChildProcess, SaysThatTheSystemEndedTheChild) {
  const Error error = errorOf([]() -> Imported {
    raise(SIGKILL);
    return {};
  });
  EXPECT_EQ(error.kind(), ErrorKind::limit);
  EXPECT_EQ(error.message(), "the system ended the process that reads it, perhaps for lack of memory");
}

} // namespace
} // namespace imgeo
