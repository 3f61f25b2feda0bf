#include "base/file.h"
#include "base/testing.h"
#include "import/ply/textures.h"
#include "import/testing.h"

#include <fmt/format.h>

namespace imgeo::testing {
namespace {

const char* const pngMagic = "\x89PNG\r\n\x1a\n...";

/// A square of two triangles and a quadrilateral beside it, in six vertices; `faceLines` follow the vertices.
std::string squaresText(const std::string& comments, const std::string& facePropertyLines,
                        const std::vector<std::string>& faceLines, const std::string& vertexValues = "",
                        const std::string& vertexPropertyLines = "") {
  std::string text = "ply\nformat ascii 1.0\n" + comments +
                     "element vertex 6\nproperty float x\nproperty float y\nproperty float z\n" + vertexPropertyLines +
                     fmt::format("element face {}\nproperty list uchar int vertex_indices\n", faceLines.size()) +
                     facePropertyLines + "end_header\n";
  for (const char* const vertex : {"0 0 0", "1 0 0", "1 1 0", "0 1 0", "2 0 0", "2 1 0"})
    text += vertex + vertexValues + "\n";
  for (const std::string& line : faceLines)
    text += line + "\n";
  return text;
}

const std::string texCoordList = "property list uchar float texcoord\n", texNumber = "property int texnumber\n";
const std::vector<std::string> twoTextures{"3 0 1 2 6 0 0 1 0 1 1 0", "3 0 2 3 6 0 0 1 1 0 1 0",
                                           "4 1 4 5 2 8 0 0 1 0 1 1 0 1 1"};

struct TexturedPly : ::testing::Test {
  Imported read(const std::string& text, bool strict = false) {
    writeFile(directory / "a.ply", asBytes(text));
    ImportOptions options;
    options.strict = strict;
    return importFile(directory / "a.ply", options);
  }
  void addImages(const std::vector<std::string>& names) {
    for (const std::string& name : names)
      writeFile(directory / name, asBytes(pngMagic));
  }
  TemporaryDirectory directory;
};

const Appearance* appearanceOfShape(const SceneGraph& graph, std::size_t root) {
  const auto& shape = std::get<Shape>(graph.nodes[graph.roots.at(root)].content);
  return shape.appearance ? &graph.appearances[*shape.appearance] : nullptr;
}

TEST_F(TexturedPly, HasTheImageThatACommentNames) {
  addImages({"my atlas.png"});
  for (const char* const end : {"\n", " \n", "\r\n"}) {
    const Imported imported = read(squaresText(fmt::format("comment TextureFile my atlas.png{}", end), texCoordList,
                                               {"3 0 1 2 6 0 0 1 0 1 1", "3 0 2 3 0"}));
    const SceneGraph& graph = imported.scene.graph;
    ASSERT_EQ(graph.roots.size(), 1u);
    const Appearance* appearance = appearanceOfShape(graph, 0);
    ASSERT_TRUE(appearance);
    EXPECT_EQ(std::get<Material>(appearance->material).diffuseColor, Vec3f(1, 1, 1));
    ASSERT_EQ(appearance->textures.size(), 1u);
    EXPECT_EQ(appearance->textures[0].role, TextureRole::color);
    EXPECT_EQ(graph.images.at(graph.textures.at(appearance->textures[0].texture).image).url, "my atlas.png");
    EXPECT_EQ(imported.warnings, std::vector<std::string>{});
  }
}

TEST_F(TexturedPly, IsAShapeForEachTexture) {
  addImages({"a.png", "b.png"});
  const Imported imported = read(
      squaresText("comment TextureFile a.png\ncomment TextureFile b.png\n", texCoordList + texNumber, twoTextures));
  const SceneGraph& graph = imported.scene.graph;
  ASSERT_EQ(graph.roots.size(), 2u);
  EXPECT_EQ(graph.nodes[graph.roots[0]].name, "a.png");
  EXPECT_EQ(graph.nodes[graph.roots[1]].name, "b.png");
  const Mesh &square = imported.scene.meshes.at(0), &rectangle = imported.scene.meshes.at(1);
  EXPECT_EQ(square.elementCount(), 2u);
  EXPECT_EQ(square.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(rectangle.elementCount(), 2u);
  EXPECT_EQ(rectangle.positions, (std::vector<Vec3f>{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(rectangle.texCoords.size(), rectangle.wedgeCount());
  EXPECT_TRUE(isConsistent(square) && isConsistent(rectangle));
  EXPECT_NE(appearanceOfShape(graph, 0)->textures[0].texture, appearanceOfShape(graph, 1)->textures[0].texture);
  EXPECT_EQ(imported.warnings, std::vector<std::string>{});
}

TEST_F(TexturedPly, IsDividedInTheSameWayWhereManyFacesAreReadInParallel) {
  addImages({"a.png", "b.png"});
  const std::size_t count = 60000;
  std::vector<std::string> faces;
  for (std::size_t i = 0; i < count; ++i)
    faces.push_back(twoTextures[i % 3]);
  const Imported imported =
      read(squaresText("comment TextureFile a.png\ncomment TextureFile b.png\n", texCoordList + texNumber, faces));
  ASSERT_EQ(imported.scene.meshes.size(), 2u);
  EXPECT_EQ(imported.scene.meshes[0].elementCount(), 2 * count / 3);
  EXPECT_EQ(imported.scene.meshes[1].elementCount(), 2 * count / 3);
}

TEST_F(TexturedPly, KeepsFacesWithoutATextureAsAShapeOfTheirOwn) {
  addImages({"a.png"});
  std::vector<std::string> faces = twoTextures;
  faces[2].back() = '7', faces[1].replace(faces[1].size() - 1, 1, "-1");
  const Imported imported = read(squaresText("comment TextureFile a.png\n", texCoordList + texNumber, faces));
  ASSERT_EQ(imported.scene.graph.roots.size(), 3u);
  EXPECT_TRUE(appearanceOfShape(imported.scene.graph, 0));
  EXPECT_FALSE(appearanceOfShape(imported.scene.graph, 1));
  EXPECT_FALSE(appearanceOfShape(imported.scene.graph, 2));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"2 triangles are of a 'texnumber' for which the PLY file names "
                                                        "no texture: without one."});
}

TEST_F(TexturedPly, HasNoVertexColoursWhereItsImageHasThem) {
  const std::string text = squaresText(
      "comment TextureFile a.png\n", "", {"3 0 1 2"}, " 0.5 0.5 10 20 30",
      "property float s\nproperty float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n");
  EXPECT_FALSE(read(text).scene.meshes.at(0).colors.empty()) << "its image is missing";
  addImages({"a.png"});
  const Imported imported = read(text);
  EXPECT_TRUE(imported.scene.meshes.at(0).colors.empty());
  EXPECT_EQ(imported.warnings, std::vector<std::string>{
                                   "The vertex colours of the PLY file were left out: its textures have the colours."});
}

TEST_F(TexturedPly, WarnsOfImagesThatAreMissingAndOfMissingTexCoords) {
  const std::string text = squaresText("comment TextureFile lost.png\n", texCoordList, {"3 0 1 2 6 0 0 1 0 1 1"});
  const Imported imported = read(text);
  ASSERT_EQ(imported.warnings.size(), 1u);
  EXPECT_NE(imported.warnings[0].find("lost.png"), std::string::npos) << imported.warnings[0];
  EXPECT_FALSE(appearanceOfShape(imported.scene.graph, 0));
  EXPECT_THROW(read(text, true), Error);
  addImages({"lost.png"});
  EXPECT_EQ(read(squaresText("comment TextureFile lost.png\n", "", {"3 0 1 2"})).warnings,
            std::vector<std::string>{"The textures of the PLY file were left out: it has no texture coordinates."});
}

TEST_F(TexturedPly, NamesATextureNumberThatHasNoTextures) {
  EXPECT_EQ(read(squaresText("", texCoordList + texNumber, twoTextures)).warnings,
            std::vector<std::string>{"Not carried over from the PLY file: 'texnumber' of 'face'."});
}

TEST_F(TexturedPly, DoesNotReadImagesOutsideOfItsFolder) {
  for (const char* const file : {"../a.png", "/etc/passwd", "https://example.org/a.png"}) {
    const Imported imported =
        read(squaresText(fmt::format("comment TextureFile {}\n", file), texCoordList, {"3 0 1 2 6 0 0 1 0 1 1"}));
    EXPECT_EQ(imported.warnings.size(), 1u) << file;
    EXPECT_TRUE(imported.scene.graph.images.empty()) << file;
  }
}

} // namespace
} // namespace imgeo::testing
