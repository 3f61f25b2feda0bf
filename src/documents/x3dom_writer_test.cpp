#include "documents/x3dom_writer.h"

#include <gtest/gtest.h>
#include <regex>

namespace imgeo {
namespace {

PatchDescription patchOf(const std::string& name, std::uint32_t rows, Primitive primitive = Primitive::triangles) {
  PatchDescription patch;
  patch.box = {{0, 0, 0}, {1, 2, 3}};
  patch.vertexCount = 9;
  patch.draws = {{primitive, 12}};
  patch.implicitMeshSize = {256, rows};
  patch.index = Reference{name + "i.png", {}};
  patch.coord = {{name + "c0.png", {}}, {name + "c1.png", {}}};
  patch.vertexAttributes[VertexRole::normal] = Reference{name + "n.png", {}};
  return patch;
}

/// A shape of two patches, one of a single patch, and points without normals.
SceneDocument imageDocument() {
  GeometryDescription twoPatches, onePatch, points;
  for (GeometryDescription* geometry : {&twoPatches, &onePatch, &points}) {
    geometry->lattice = {{1, 2, 3}, 0.25, 12};
    geometry->colorComponents = 4;
    geometry->box = {{0, 0, 0}, {1, 2, 3}};
  }
  twoPatches.patches = {patchOf("a", 7), patchOf("b", 20)};
  onePatch.patches = {patchOf("c", 1)};
  points.patches = {patchOf("d", 2, Primitive::points)};
  points.patches[0].vertexAttributes[VertexRole::normal].reset();
  SceneDocument document;
  document.geometries = {twoPatches, onePatch, points};
  document.graph.appearances.resize(3);
  const char* names[] = {"statue", "base", ""};
  for (std::size_t i = 0; i < 3; ++i)
    addRoot(document.graph, {names[i], Shape{i, i, true}, {}, ""});
  return document;
}

/// The same scene in BinaryGeometry nodes.
SceneDocument arrayDocument() {
  SceneDocument document = imageDocument();
  for (GeometryDescription& geometry : document.geometries) {
    geometry.encoding = Encoding::bg;
    geometry.colorComponents = 3;
    for (PatchDescription& patch : geometry.patches) {
      patch.coord = {{patch.coord[0].url, ByteLocation{0, 8}}};
      patch.implicitMeshSize = {256, 256};
      if (patch.vertexAttributes[VertexRole::normal])
        patch.vertexAttributes[VertexRole::normal]->location = ByteLocation{0, 4};
      if (patch.index)
        patch.index->location = ByteLocation{};
    }
  }
  return document;
}

std::size_t countOf(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  return static_cast<std::size_t>(
      std::distance(std::sregex_iterator(text.begin(), text.end(), expression), std::sregex_iterator()));
}

/// Expects that a document reads back equal, except for the changes that X3DOM requires.
void expectReadsBackAs(const SceneDocument& written, const std::string& text) {
  const SceneDocument read = readScene(text, "x");
  const std::vector<std::size_t> shapes = shapeNodes(read.graph);
  ASSERT_EQ(shapes.size(), written.graph.nodes.size());
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    EXPECT_EQ(read.graph.nodes[shapes[i]].name, written.graph.nodes[i].name);
    GeometryDescription geometry = read.geometries.at(shapeOf(read.graph, shapes[i]).mesh);
    const GeometryDescription& expected = written.geometries.at(i);
    EXPECT_NEAR(geometry.lattice.step, expected.lattice.step, 1e-10 * expected.lattice.step);
    EXPECT_EQ(geometry.lattice.bits, expected.lattice.bits);
    geometry.lattice = expected.lattice;
    geometry.attributeTypes = expected.attributeTypes; // not written for attributes that are absent
    for (PatchDescription& patch : geometry.patches)
      patch.implicitMeshSize.y =
          expected.patches.at(static_cast<std::size_t>(&patch - geometry.patches.data())).implicitMeshSize.y;
    EXPECT_EQ(geometry, expected);
  }
}

TEST(X3domWriter, WritesTheSameScene) {
  expectReadsBackAs(imageDocument(), writeX3domX3d(imageDocument()));
  expectReadsBackAs(arrayDocument(), writeX3domX3d(arrayDocument()));
  expectReadsBackAs(imageDocument(),
                    writeX3domHtml(imageDocument(), {"x3dom/x3dom.js", "", "x3dom/x3dom.css", ""}, "imgeo.css"));
}

TEST(X3domWriter, WritesOneImplicitMeshSizeForThePage) {
  const std::string text = x3domElement(imageDocument(), 0, DocumentKind::file);
  EXPECT_EQ(countOf(text, "implicitMeshSize=\"256 20\""), 4u);
  EXPECT_EQ(countOf(text, "implicitMeshSize"), 4u);
}

TEST(X3domWriter, DisablesFilteringAndScalingOfTexels) {
  const std::string text = x3domElement(imageDocument(), 0, DocumentKind::file);
  const std::size_t textures = countOf(text, "<ImageTexture ");
  EXPECT_EQ(textures, 4u + 4 + 4 + 3);
  EXPECT_EQ(countOf(text, "containerField=\"(index|coord|normal)\" url='\"[a-d][a-z0-9]+.png\"' scale=\"false\">"),
            textures);
  EXPECT_EQ(countOf(text, "<TextureProperties USE=\"exactTexels\">"), textures - 1);
  EXPECT_EQ(countOf(text, "<TextureProperties DEF=\"exactTexels\""), 1u);
}

TEST(X3domWriter, GivesTheGroupTheNameAndItsShapesOneAppearance) {
  for (const SceneDocument& document : {imageDocument(), arrayDocument()}) {
    const std::string text = x3domElement(document, 0, DocumentKind::file);
    EXPECT_EQ(countOf(text, "<Group DEF=\"statue\""), 1u);
    EXPECT_EQ(countOf(text, "<Appearance DEF=\"statue-appearance\">"), 1u);
    EXPECT_EQ(countOf(text, "<Appearance USE=\"statue-appearance\">"), 1u);
    EXPECT_EQ(countOf(text, "<Shape DEF=\"base\""), 1u);
    EXPECT_EQ(countOf(text, "<Material "), 3u);
  }
}

TEST(X3domWriter, AvoidsNamesOfShapes) {
  SceneDocument document = imageDocument();
  document.graph.nodes[1].name = "statue-appearance";
  document.graph.nodes[2].name = "exactTexels";
  const std::string text = x3domElement(document, 0, DocumentKind::file);
  EXPECT_EQ(countOf(text, "DEF=\"statue-appearance\""), 1u);
  EXPECT_EQ(countOf(text, "<Appearance USE=\"statue-appearance_2\">"), 1u);
  EXPECT_EQ(countOf(text, "<TextureProperties DEF=\"exactTexels_2\""), 1u);
}

TEST(X3domWriter, LightsOnlyTrianglesWithNormals) {
  EXPECT_EQ(countOf(x3domElement(imageDocument(), 0, DocumentKind::file), "lit=\"false\""), 1u);
  EXPECT_EQ(countOf(x3domElement(imageDocument(), 0, DocumentKind::file), "emissiveColor"), 1u);
}

TEST(X3domWriter, WritesAStrideAsAQuery) {
  const std::string text = x3domElement(arrayDocument(), 0, DocumentKind::file);
  EXPECT_EQ(countOf(text, "coord=\"[a-d]c0.png\\?\\+8\""), 4u);
  EXPECT_EQ(countOf(text, "normal=\"[a-d]n.png\\?\\+4\""), 3u);
  EXPECT_EQ(countOf(text, "index=\"[a-d]i.png\""), 4u);
}

TEST(X3domWriter, WritesTheLatticeWithTheMinimumNumberOfDigits) {
  SceneDocument document = arrayDocument();
  for (GeometryDescription& geometry : document.geometries)
    geometry.lattice = {{0.1, 0.2, 0.3}, 0.15 / 65535, 16};
  const std::string text = x3domElement(document, 0, DocumentKind::file);
  EXPECT_EQ(countOf(text, "position=\"0.175 0.275 0.375\" size=\"0.15 0.15 0.15\""), 4u) << text;
}

TEST(X3domWriter, WritesTheFourStylesOfFontsOnly) {
  SceneDocument document;
  for (const char* style : {"BOLDITALIC", "position: fixed"}) {
    const Node node{"", GenericNode{"FontStyle", "", {}}, {}, "", {{"style", style}}};
    document.graph.roots.push_back(addNode(document.graph, node));
  }
  const std::string text = x3domElement(document, 0, DocumentKind::page);
  EXPECT_EQ(countOf(text, "<FontStyle style=\"BOLDITALIC\"></FontStyle>"), 1u) << text;
  EXPECT_EQ(countOf(text, "<FontStyle style=\"PLAIN\"></FontStyle>"), 1u) << text;
}

} // namespace
} // namespace imgeo
