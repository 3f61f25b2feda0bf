#include "base/file.h"
#include "base/testing.h"
#include "import/gltf/testing.h"
#include "import/testing.h"
#include "scene/shape_instances.h"
#include "scene/testing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo::testing {
namespace {

Vec3d originOf(const ShapeInstance& instance) {
  return instance.worldFromShape.point({0, 0, 0});
}

bool hasWarning(const Imported& imported, const std::string& words) {
  return std::ranges::any_of(imported.warnings, [&](const std::string& w) { return w.find(words) != w.npos; });
}

TEST(GltfNodes, KeepNamesTransformsAndHierarchy) {
  GltfText gltf;
  const std::size_t mesh = gltf.addTriangle();
  gltf.addNode({{"name", "arm"}, {"translation", {1, 0, 0}}, {"children", {1}}});
  gltf.addNode({{"name", "hand"}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}, {"mesh", mesh}});
  gltf.json["scenes"] = {{{"name", "robot"}, {"nodes", {0}}}};
  const Imported imported = read(gltf);
  const SceneGraph& graph = imported.scene.graph;
  EXPECT_EQ(imported.format, "glTF");
  EXPECT_EQ(graph.title, "robot");
  const Node& arm = graph.nodes[graph.roots.at(0)];
  EXPECT_EQ(arm.name, "arm");
  EXPECT_EQ(std::get<Transform>(arm.content).translation, (Vec3d{1, 0, 0}));
  EXPECT_EQ(graph.nodes[arm.children.at(0)].name, "hand");
  const std::vector<ShapeInstance> instances = shapeInstances(graph);
  ASSERT_EQ(instances.size(), 1u);
  EXPECT_LE(length(instances[0].worldFromShape.point({1, 0, 0}) - Vec3d{1, 1, 0}), 1e-7);
}

TEST(GltfNodes, ShareTheirMesh) {
  GltfText gltf;
  const std::size_t mesh = gltf.addTriangle();
  for (int i = 0; i < 100; ++i)
    gltf.addNode({{"mesh", mesh}, {"translation", {i, 0, 0}}});
  const Scene scene = read(gltf).scene;
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(shapeNodes(scene.graph).size(), 1u);
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  ASSERT_EQ(instances.size(), 100u);
  EXPECT_EQ(originOf(instances[7]), (Vec3d{7, 0, 0}));
}

TEST(GltfNodes, ShareAMeshIfOnlyTheirMaterialsDiffer) {
  GltfText gltf;
  gltf.addTriangle();
  gltf.json["materials"] = {{{"name", "red"}}, {{"name", "blue"}, {"doubleSided", true}}};
  GltfText::Json primitive = gltf.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  GltfText::Json other = primitive;
  other["material"] = 1;
  gltf.show(gltf.addMesh({primitive, other}));
  const Scene scene = read(gltf).scene;
  EXPECT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(shapeNodes(scene.graph).size(), 2u);
  EXPECT_EQ(appearanceOf(scene.graph, 0).name, "red");
  EXPECT_EQ(appearanceOf(scene.graph, 1).name, "blue");
  EXPECT_TRUE(shapeOf(scene.graph, shapeNodes(scene.graph)[0]).solid);
  EXPECT_FALSE(shapeOf(scene.graph, shapeNodes(scene.graph)[1]).solid);
}

TEST(GltfNodes, KeepMatricesThatShear) {
  GltfText gltf;
  gltf.addNode({{"mesh", gltf.addTriangle()}, {"matrix", {1, 0, 0, 0, 0.5, 2, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}});
  const std::vector<ShapeInstance> instances = shapeInstances(read(gltf).scene.graph);
  EXPECT_LE(length(instances.at(0).worldFromShape.point({0, 1, 0}) - Vec3d{7.5, 10, 9}), 1e-7);
}

TEST(GltfNodes, AreRepeatedByGpuInstancing) {
  GltfText gltf;
  const std::size_t mesh = gltf.addTriangle();
  const std::size_t translations = gltf.addAccessor<float>({1, 0, 0, 2, 0, 0, 3, 0, 0}, "VEC3", 5126);
  gltf.addNode({{"mesh", mesh},
                {"translation", {0, 5, 0}},
                {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", {{"TRANSLATION", translations}}}}}}}});
  const Scene scene = read(gltf).scene;
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  ASSERT_EQ(instances.size(), 3u);
  EXPECT_EQ(originOf(instances[2]), (Vec3d{3, 5, 0}));
  EXPECT_EQ(shapeNodes(scene.graph).size(), 1u);
}

TEST(GltfNodes, KeepCameras) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json["cameras"] = {
      {{"name", "door"}, {"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"znear", 1}}}},
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.9}, {"aspectRatio", 0.5}, {"znear", 1}}}},
      {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 1}}}}};
  gltf.addNode({{"name", "eye"}, {"camera", 0}, {"translation", {0, 0, 4}}});
  gltf.addNode({{"camera", 1}});
  gltf.addNode({{"name", "plan"}, {"camera", 2}});
  const SceneGraph graph = read(gltf).scene.graph;
  const Viewpoint* viewpoint = firstOf<Viewpoint>(graph);
  ASSERT_TRUE(viewpoint);
  EXPECT_EQ(viewpoint->description, "door");
  EXPECT_DOUBLE_EQ(viewpoint->fieldOfView, 0.9);
  EXPECT_EQ(viewpoint->position, Vec3d{});
  const Viewpoint& narrow = std::get<Viewpoint>(graph.nodes[graph.roots.at(2)].content);
  EXPECT_NEAR(narrow.fieldOfView, 2 * std::atan(std::tan(0.45) * 0.5), 1e-9);
  const OrthoViewpoint* plan = firstOf<OrthoViewpoint>(graph);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->description, "plan");
  EXPECT_EQ(plan->max, (Vec2<double>{3, 2}));
}

TEST(GltfNodes, KeepLights) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "directional"}, {"intensity", 2}},
      {{"type", "point"}, {"color", {1, 0.5, 0}}, {"range", 12}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
  for (int light = 0; light < 3; ++light)
    gltf.addNode({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  const SceneGraph graph = read(gltf).scene.graph;
  ASSERT_TRUE(firstOf<DirectionalLight>(graph) && firstOf<PointLight>(graph) && firstOf<SpotLight>(graph));
  EXPECT_EQ(firstOf<DirectionalLight>(graph)->intensity, 2);
  EXPECT_TRUE(firstOf<DirectionalLight>(graph)->global);
  EXPECT_EQ(firstOf<PointLight>(graph)->radius, 12);
  EXPECT_EQ(firstOf<PointLight>(graph)->attenuation, (Vec3d{0, 0, 1}));
  EXPECT_EQ(firstOf<SpotLight>(graph)->cutOffAngle, 0.5);
}

TEST(GltfNodes, KeepTheRangeOfLightsUnderAScale) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"range", 12}}};
  const std::size_t lamp =
      gltf.addNode({{"scale", {2, 2, 2}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  gltf.addNode({{"scale", {2, 2, 2}}, {"children", {lamp}}});
  const SceneGraph graph = read(gltf).scene.graph;
  ASSERT_TRUE(firstOf<PointLight>(graph));
  EXPECT_NEAR(firstOf<PointLight>(graph)->radius, 3, 1e-12);
  EXPECT_NEAR(firstOf<PointLight>(graph)->attenuation.z, 16, 1e-12);
}

TEST(GltfNodes, KeepExtras) {
  GltfText gltf;
  gltf.addNode({{"name", "door"}, {"mesh", gltf.addTriangle()}, {"extras", {{"material", "oak"}, {"price", 12}}}});
  const SceneGraph graph = read(gltf).scene.graph;
  EXPECT_EQ(graph.nodes[graph.roots.at(0)].extras, R"({"material":"oak","price":12})");
}

TEST(GltfNodes, KeepTheNavigationTypeOfAnExportedScene) {
  const auto fieldsOf = [](const GltfText::Json& extras) {
    GltfText gltf;
    gltf.addNode({{"mesh", gltf.addTriangle()}});
    gltf.json["scenes"] = {{{"nodes", {0}}, {"extras", extras}}};
    const SceneGraph graph = read(gltf).scene.graph;
    const Node& first = graph.nodes[graph.roots.at(0)];
    return std::holds_alternative<GenericNode>(first.content) ? first.fields : std::vector<FieldText>{};
  };
  EXPECT_EQ(fieldsOf({{"NavigationInfo", {{"type", {"WALK", 7, "ANY"}}}}}),
            (std::vector<FieldText>{{"type", "\"WALK\" \"ANY\""}}));
  for (const GltfText::Json& foreign :
       {GltfText::Json(7), GltfText::Json{{"NavigationInfo", "WALK"}},
        GltfText::Json{{"NavigationInfo", {{"type", 7}}}}, GltfText::Json{{"NavigationInfo", {{"type", nullptr}}}}})
    EXPECT_TRUE(fieldsOf(foreign).empty()) << foreign;
}

TEST(GltfNodes, WarnAboutContentThatIsNotCarriedOver) {
  GltfText gltf;
  gltf.addNode({{"mesh", gltf.addTriangle()}});
  gltf.json["meshes"][0]["primitives"][0]["attributes"]["JOINTS_2"] = 0;
  gltf.json["materials"] = {{{"extensions", {{"ADOBE_materials_clearcoat_tint", GltfText::Json::object()}}}}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Imported imported = read(gltf);
  for (const char* words : {"JOINTS_2", "ADOBE_materials_clearcoat_tint: the material"})
    EXPECT_TRUE(hasWarning(imported, words)) << words;
  EXPECT_EQ(imported.warnings.size(), 2u);
}

TEST(GltfNodes, ThatFormACycleAreLeftOutOrRefusedIfStrict) {
  GltfText gltf;
  const std::size_t mesh = gltf.addTriangle();
  gltf.addNode({{"mesh", mesh}, {"children", {1}}});
  gltf.addNode({{"children", {0}}});
  gltf.json["scenes"] = {{{"nodes", {0}}}};
  const Imported imported = read(gltf);
  EXPECT_EQ(shapeInstances(imported.scene.graph).size(), 1u);
  EXPECT_TRUE(hasWarning(imported, "nodes[0]: is the child of two nodes"));
  EXPECT_THROW(read(gltf, {.attributes = {}, .folder = {}, .outside = false, .strict = true}), Error);
}

TEST(GltfNodes, ThatAreHiddenStayHidden) {
  GltfText gltf;
  gltf.addNode({{"mesh", gltf.addTriangle()}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}});
  const SceneGraph graph = read(gltf).scene.graph;
  EXPECT_EQ(graph.nodes[graph.roots.at(0)].fields, (std::vector<FieldText>{{"visible", "false"}}));
}

TEST(GltfNodes, WithVariantsAreChoicesOfASwitch) {
  GltfText gltf;
  gltf.addTriangle();
  gltf.json["materials"] = {{{"name", "red"}}, {{"name", "blue"}}};
  gltf.json["extensions"]["KHR_materials_variants"]["variants"] = {
      {{"name", "day"}}, {{"name", "night"}}, {{"name", "dusk"}}};
  GltfText::Json& primitive = gltf.json["meshes"][0]["primitives"][0];
  primitive["material"] = 0;
  primitive["extensions"]["KHR_materials_variants"]["mappings"] =
      GltfText::Json::array({{{"material", 1}, {"variants", {1, 2}}}});
  gltf.show(0);
  const SceneGraph graph = read(gltf).scene.graph;
  const Node& choice = graph.nodes[graph.roots.at(0)];
  EXPECT_EQ(std::get<GenericNode>(choice.content).element, "Switch");
  EXPECT_EQ(choice.fields, (std::vector<FieldText>{{"whichChoice", "0"}, {"class", "variants"}}));
  ASSERT_EQ(choice.children.size(), 4u);
  EXPECT_EQ(choice.children[1], choice.children[0]); // day has no material of its own
  EXPECT_EQ(choice.children[3], choice.children[2]);
  const auto appearance = [&](std::size_t child) {
    return graph.appearances[std::get<Shape>(graph.nodes[choice.children[child]].content).appearance.value()].name;
  };
  EXPECT_EQ(appearance(0), "red");
  EXPECT_EQ(appearance(2), "blue");
  EXPECT_EQ(graph.nodes[choice.children[2]].name, "night");
  EXPECT_EQ(graph.info, std::vector<std::string>{"variants: day, night, dusk"});
}

TEST(GltfNodes, OfWhichNothingIsLeftFailWithTheCause) {
  const TemporaryDirectory directory;
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  GltfText::Json whole = gltf.json;
  whole["buffers"] = {{{"byteLength", 36}, {"uri", "missing.bin"}}};
  writeFile(directory / "a.gltf", asBytes(whole.dump()));
  try {
    importFile(directory / "a.gltf", {});
    ADD_FAILURE() << "was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string(error.what()).find("missing.bin: cannot open"), std::string::npos) << error.what();
  }
}

TEST(GltfNodes, StayWhereTheirMaterialIsDamaged) {
  GltfText gltf;
  gltf.show(gltf.addTriangle());
  gltf.json["materials"] = {{{"pbrMetallicRoughness", "steel"}}};
  gltf.json["meshes"][0]["primitives"][0]["material"] = 0;
  const Imported imported = read(gltf);
  EXPECT_EQ(shapeInstances(imported.scene.graph).size(), 1u);
  EXPECT_TRUE(hasWarning(imported, "Left out: a.gltf, materials[0].pbrMetallicRoughness: is no object"));
}

TEST(GltfNodes, OfVersionOneAreRefused) {
  for (const char* version : {"1.0", "\"1.0\"", "1"})
    EXPECT_NE(std::string(errorOf(fmt::format(R"({{"asset":{{"version":{}}}}})", version), "a.gltf").what())
                  .find("is glTF 1.0; imgeo reads glTF 2"),
              std::string::npos);
}

TEST(GltfNodes, NestedTooDeeplyAreRefused) {
  GltfText gltf;
  gltf.addTriangle();
  for (int i = 0; i < 1000; ++i)
    gltf.addNode({{"children", {i + 1}}});
  gltf.addNode({{"mesh", 0}});
  EXPECT_EQ(errorOf(gltf.text(), "a.gltf").kind(), ErrorKind::limit);
  EXPECT_EQ(errorOf(std::string(1000, '[') + "\"asset\"", "a.gltf").kind(), ErrorKind::limit);
}

} // namespace
} // namespace imgeo::testing
