#include "documents/equal_geometries.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

GeometryDescription geometryOf(const std::string& url) {
  GeometryDescription geometry;
  geometry.patches.emplace_back();
  geometry.patches[0].data = Reference{url, {}};
  return geometry;
}

TEST(EqualGeometries, AreSharedByTheirShapesInTheOrderOfTheFirst) {
  GeometryDescription clockwise = geometryOf("a.png");
  clockwise.ccw = false;
  SceneDocument document;
  document.geometries = {geometryOf("a.png"), geometryOf("b.png"), geometryOf("a.png"), clockwise, geometryOf("b.png")};
  for (std::size_t mesh = 0; mesh < document.geometries.size(); ++mesh)
    addRoot(document.graph, {"", Shape{.mesh = mesh, .appearance = {}}, {}, ""});
  shareEqualGeometries(document);
  ASSERT_EQ(document.geometries.size(), 3u);
  EXPECT_EQ(document.geometries[1], geometryOf("b.png"));
  EXPECT_EQ(document.geometries[2], clockwise) << "the same file, drawn otherwise";
  std::vector<std::size_t> meshes;
  for (const std::size_t node : shapeNodes(document.graph))
    meshes.push_back(shapeOf(document.graph, node).mesh);
  EXPECT_EQ(meshes, (std::vector<std::size_t>{0, 1, 0, 2, 1}));
}

} // namespace
} // namespace imgeo
