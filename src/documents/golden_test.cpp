// Golden documents of format version 1, which later readers must still read. IMGEO_REWRITE_GOLDEN=1 rewrites them.

#include "base/file.h"
#include "documents/documents.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

const std::filesystem::path golden = IMGEO_GOLDEN;

SceneDocument goldenDocument() {
  GeometryDescription sig;
  sig.lattice = {{-1.5, 0, 0.25}, 3.0 / 65535, 16};
  sig.box = {{-1.5, 0, 0.25}, {1.5, 2, 1.25}};
  PatchDescription patch;
  patch.box = {{-1.5, 0, 0.25}, {0, 2, 1.25}};
  patch.vertexCount = 65535;
  patch.draws = {{Primitive::triangles, 391140}};
  patch.implicitMeshSize = {1024, 382};
  patch.index = Reference{"3f786850e387550f.png", {}};
  patch.coord = {{"89e6c98d92887913.png", {}}, {"2b66fd261ee5c6cf.png", {}}};
  patch.vertexAttributes[VertexRole::normal] = Reference{"da4b9237bacccdf1.png", {}};
  sig.patches = {patch, patch};
  sig.patches[1].box.min.x = 0;
  sig.patches[1].box.max.x = 1.5;
  sig.patches[1].vertexAttributes[VertexRole::normal]->location = TexelLocation{4096};

  GeometryDescription bg;
  bg.encoding = Encoding::bg;
  bg.lattice = {{0, 0, 0}, 0.001, 12};
  bg.box = {{0, 0, 0}, {1, 1, 0}};
  bg.texCoordBoxes[0].size = {2, 1};
  bg.colorComponents = 4;
  PatchDescription strip;
  strip.box = bg.box;
  strip.vertexCount = 12;
  strip.draws = {{Primitive::triangleStrip, 10}, {Primitive::points, 3}};
  strip.index = Reference{"1b6453892473a467.bin", ByteLocation{}};
  strip.coord = {{"c1dfd96eea8cc2b6.bin", ByteLocation{0, 8}}};
  strip.vertexAttributes[VertexRole::texCoord] = Reference{"902ba3cda1883801.bin", ByteLocation{16, 24}};
  strip.vertexAttributes[VertexRole::color] = Reference{"fe5dbbcea5ce7e29.bin", ByteLocation{}};
  bg.patches = {strip};

  SceneDocument document;
  document.geometries = {sig, bg};
  SceneGraph& graph = document.graph;
  graph.title = "Statue & base";
  graph.background = Background{{0.93f, 0.94f, 0.95f}};
  graph.appearances.resize(2);
  graph.appearances[1].material = Material{{1, 0.5f, 0}, {0.1f, 0.1f, 0.1f}, {0, 0, 0.2f}, 0.3f, 0.4f, 0.5f};
  addRoot(graph, {"", Viewpoint{"Start", {0, 1, 5.5}, {{0, 1, 0}, 0.25}, 0.7854, {0, 1, 0.75}}, {}, ""});
  addRoot(graph, {"", DirectionalLight{{0, -1, -1}, {1, 1, 0.9f}, 0.8f, false}, {}, ""});
  addRoot(graph, {"statue", Shape{0, 0, true}, {}, ""});
  addRoot(graph, {"", Shape{1, 1, true}, {}, ""});
  return document;
}

std::string goldenText(const std::string& name, const std::string& written) {
  if (std::getenv("IMGEO_REWRITE_GOLDEN") != nullptr)
    writeFile(golden / name, asBytes(written));
  return std::string(asText(readFile(golden / name)));
}

TEST(GoldenDocuments, AreStillWrittenAndRead) {
  const SceneDocument document = goldenDocument();
  const std::string x3d = writeX3d(document), html = writeHtml(document, {"imgeo.js", "imgeo.css"});
  EXPECT_EQ(x3d, goldenText("document-1.x3d", x3d));
  EXPECT_EQ(html, goldenText("document-1.html", html));
  for (const std::string name : {"document-1.x3d", "document-1.html"}) {
    const SceneDocument read = readScene(asText(readFile(golden / name)), name);
    ASSERT_EQ(read.geometries.size(), 2u);
    EXPECT_EQ(read.graph.title, document.graph.title);
    EXPECT_EQ(read.geometries[0].patches[1].coord, document.geometries[0].patches[1].coord);
    EXPECT_EQ(read.geometries[1].patches, document.geometries[1].patches);
  }
}

} // namespace
} // namespace imgeo
