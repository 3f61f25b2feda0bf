// ExternalGeometry and ExternalShape, the nodes of X3DOM that name Shape Resource Containers.

#include "import/gltf/resource_testing.h"
#include "import/references.h"
#include "import/testing.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <fmt/format.h>

namespace imgeo::x3d::testing {
namespace {

using namespace imgeo::testing;

std::string glbUrl() {
  return dataUrlOf(glbFile(squareGltf(), squareBody()), "model/gltf.binary");
}
std::string srcUrl() {
  return dataUrlOf(srcFile(squareSrc(), squareBody()), "application/octet-stream");
}

Imported read(const std::string& nodes, const std::string& name = "old.x3d") {
  return importBytes(asBytes("<X3D><Scene>" + nodes + "<Shape><Box/></Shape></Scene></X3D>"), name);
}

TEST(ExternalGeometry, BecomesAShapeForEachKindOfElementWithItsAppearance) {
  for (const std::string& url : {glbUrl(), srcUrl()}) {
    const Imported imported = read("<Shape DEF='A' visible='false'><Appearance><Material/></Appearance>"
                                   "<ExternalGeometry solid='false' url='" +
                                   url + "'/></Shape>");
    EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
    const SceneGraph& graph = imported.scene.graph;
    const std::vector<std::size_t> shapes = shapeNodes(graph);
    ASSERT_EQ(shapes.size(), 2u);
    for (const std::size_t node : shapes) {
      EXPECT_FALSE(shapeOf(graph, node).solid);
      EXPECT_EQ(graph.nodes[node].children.size(), 1u);
      EXPECT_EQ(graph.nodes[node].fields, (std::vector<FieldText>{{"visible", "false"}}));
    }
    EXPECT_EQ(graph.nodes[graph.roots[0]].name, "A");
  }
}

TEST(ExternalGeometry, HasTheMeshOfTheFirstUrlThatCanBeReadAndItsOrientation) {
  const Imported imported = read("<Shape><ExternalGeometry ccw='false' url='\"missing.src\" \"" + srcUrl() +
                                 "#none\" \"" + srcUrl() + "#square\"'/></Shape>");
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  ASSERT_EQ(imported.scene.meshes.size(), 1u);
  EXPECT_EQ(imported.scene.meshes[0].cornerPosition(1), (Vec3f{2, 2, 1}));
  EXPECT_EQ(imported.scene.meshes[0].cornerPosition(2), (Vec3f{2, 0, 1}));
}

TEST(ExternalGeometry, IsNotLitWhereItsNodeSaysSo) {
  const Imported imported = read("<Shape><Appearance><Material/></Appearance><ExternalGeometry lit='false' url='" +
                                 srcUrl() + "#square'/></Shape>");
  EXPECT_EQ(imported.scene.meshes.size(), 1u);
  EXPECT_TRUE(std::ranges::any_of(imported.scene.graph.nodes, [](const Node& node) {
    const GenericNode* generic = std::get_if<GenericNode>(&node.content);
    return generic && generic->element == "UnlitMaterial";
  }));
}

TEST(ExternalGeometry, IsReadFromAPage) {
  const std::string page = "<!doctype html><title>Old</title><x3d><scene><shape><externalgeometry url='" + srcUrl() +
                           "#square'></externalgeometry></shape><externalshape url='" + glbUrl() +
                           "#square'></externalshape></scene></x3d>";
  EXPECT_EQ(importBytes(asBytes(page), "old.html").scene.meshes.size(), 2u);
}

TEST(ExternalShape, HasTheMaterialsOfItsFileAndX3dsDefaultWithoutOne) {
  const Imported imported = read("<Group><ExternalShape DEF='A' url='" + glbUrl() +
                                 "'/><ExternalShape USE='A'/></Group><ExternalShape url='" + srcUrl() + "#square'/>");
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::vector<ShapeInstance> instances = shapeInstances(graph);
  ASSERT_EQ(instances.size(), 5u);
  EXPECT_EQ(imported.scene.meshes.size(), 3u);
  const auto appearanceOf = [&](std::size_t i) {
    return graph.appearances.at(*shapeOf(graph, instances[i].node).appearance);
  };
  EXPECT_EQ(appearanceOf(0).name, "red");
  EXPECT_EQ(appearanceOf(1).name, "glow");
  EXPECT_FALSE(shapeOf(graph, instances[0].node).solid);
  EXPECT_EQ(std::get<Material>(appearanceOf(4).material), Material{});
}

TEST(ExternalShape, ThatCannotBeReadIsLeftOutWithOneWarningAndTheSceneLives) {
  Bytes file = srcFile(squareSrc(), squareBody());
  file[8] = file[9] = file[10] = 255; // the header's length
  const std::string lying = dataUrlOf(file, "application/octet-stream");
  ImportOptions strict;
  strict.strict = true;
  for (const auto& [url, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {lying, "has a header of 16777215 bytes"},
           {"missing.src", "missing.src"},
           {"https://example.org/a.src", "https://example.org/a.src"},
           {srcUrl() + "#none", "has no mesh \"none\""},
           {"", "there is no url"}})
    for (const std::string& node : {fmt::format("<ExternalShape url='{}'/>", url),
                                    fmt::format("<Shape><ExternalGeometry url='{}'/></Shape>", url)}) {
      SCOPED_TRACE(message);
      const Imported imported = read(node);
      EXPECT_TRUE(imported.scene.meshes.empty());
      ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
      const std::string& warning = imported.warnings[0];
      EXPECT_TRUE(warning.starts_with("old.x3d:1:")) << warning;
      EXPECT_EQ(warning.find("old.x3d", 1), std::string::npos) << warning;
      EXPECT_NE(warning.find(message), std::string::npos) << warning;
      EXPECT_LT(warning.size(), 250u) << warning;
      const Error error = errorOf("<X3D><Scene>" + node + "<Shape><Box/></Shape></Scene></X3D>", "old.x3d", strict);
      EXPECT_NE(error.kind(), ErrorKind::io);
    }
}

} // namespace
} // namespace imgeo::x3d::testing
