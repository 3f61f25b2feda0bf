#include "base/testing.h"
#include "import/gltf/testing.h"
#include "import/testing.h"
#include "scene/deformation.h"
#include "scene/moving_boxes.h"
#include "scene/pose.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace imgeo::testing {
namespace {

using Json = GltfText::Json;

constexpr float notANumber = std::numeric_limits<float>::quiet_NaN();

/// A triangle with two joints, one below the other, the second one unit above the first; corner n is moved by joint n.
struct SkinnedTriangle {
  GltfText gltf;
  std::vector<std::uint8_t> joints{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0};
  std::vector<float> weights{1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0};
  std::vector<float> matrices{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,
                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1};
  Json skin{{"name", "legs"}, {"joints", {1, 2}}};

  Imported read(const ImportOptions& options = {}) {
    gltf.addNode({{"name", "body"}, {"mesh", gltf.addTriangle()}, {"skin", 0}, {"translation", {9, 9, 9}}});
    gltf.addNode({{"name", "hip"}, {"children", {2}}});
    gltf.addNode({{"name", "knee"}, {"translation", {0, 1, 0}}});
    Json& attributes = gltf.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_0"] = gltf.addAccessor(joints, "VEC4", 5121);
    attributes["WEIGHTS_0"] = gltf.addAccessor(weights, "VEC4", 5126);
    skin["inverseBindMatrices"] = gltf.addAccessor(matrices, "MAT4", 5126);
    gltf.json["skins"] = Json::array({skin});
    return testing::read(gltf, options);
  }
};

template <typename Content> std::vector<std::size_t> nodesWith(const SceneGraph& graph) {
  std::vector<std::size_t> nodes = nodesInOrder(graph);
  std::erase_if(nodes, [&](std::size_t node) { return !std::holds_alternative<Content>(graph.nodes[node].content); });
  return nodes;
}

bool warns(const Imported& imported, const std::string& words) {
  return std::ranges::any_of(imported.warnings,
                             [&](const std::string& warning) { return warning.find(words) != warning.npos; });
}

std::size_t nodeNamed(const SceneGraph& graph, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(graph.nodes, name, &Node::name) - graph.nodes.begin());
}

TEST(GltfSkins, BecomeAHumanoidThatNamesJointsOfTheScene) {
  const Imported imported = SkinnedTriangle().read();
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::vector<std::size_t> humanoids = nodesWith<Humanoid>(graph);
  ASSERT_EQ(humanoids.size(), 1u);
  EXPECT_EQ(graph.roots.back(), humanoids[0]) << "behind its joints";
  EXPECT_EQ(graph.nodes[humanoids[0]].name, "legs");
  const Humanoid& humanoid = std::get<Humanoid>(graph.nodes[humanoids[0]].content);
  EXPECT_EQ(humanoid.joints, (std::vector{nodeNamed(graph, "hip"), nodeNamed(graph, "knee")}));
  for (const std::size_t joint : humanoid.joints)
    EXPECT_TRUE(std::get<Transform>(graph.nodes[joint].content).isJoint);
  EXPECT_EQ(humanoid.inverseBindings[1].translation, (Vec3d{0, -1, 0}));
  const Mesh& mesh = imported.scene.meshes.at(0);
  EXPECT_EQ(jointSetCount(mesh), 1u);
  EXPECT_TRUE(graph.nodes[nodeNamed(graph, "body")].children.empty()) << "its transform does not count";
}

TEST(GltfSkins, MoveVerticesWithTheirJoints) {
  SkinnedTriangle triangle;
  Imported imported = triangle.read();
  SceneGraph& graph = imported.scene.graph;
  const std::size_t shape = nodesWith<Shape>(graph).at(0), knee = nodeNamed(graph, "knee");
  EXPECT_EQ(posedMesh(imported.scene, shape).positions, imported.scene.meshes[0].positions) << "at rest";
  Pose pose;
  pose.transforms[knee] = std::get<Transform>(graph.nodes[knee].content);
  pose.transforms[knee].translation = {0, 1, 2};
  const Mesh moved = posedMesh(imported.scene, shape, pose);
  EXPECT_EQ(moved.positions[0], (Vec3f{0, 0, 0}));
  EXPECT_EQ(moved.positions[1], (Vec3f{1, 0, 2}));
  EXPECT_EQ(moved.positions[2], (Vec3f{0, 1, 1}));
}

TEST(GltfSkins, HaveABoxAroundAllMomentsOfTheirAnimations) {
  SkinnedTriangle triangle;
  const std::size_t times = triangle.gltf.addAccessor<float>({0, 1, 2}, "SCALAR", 5126),
                    values = triangle.gltf.addAccessor<float>({0, 1, 0, 0, 1, 5, 0, 1, 0}, "VEC3", 5126);
  triangle.gltf.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", values}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 2}, {"path", "translation"}}}}}}}});
  Imported imported = triangle.read();
  EXPECT_EQ(imported.scene.graph.routes.size(), 2u) << "joints are animated though nothing is below them";
  setMovingBoxes(imported.scene);
  const Box3d box = shapeOf(imported.scene.graph, nodesWith<Shape>(imported.scene.graph).at(0)).movingBox;
  EXPECT_LE(box.min.z, 0);
  EXPECT_GE(box.max.z, 5);
  EXPECT_LE(box.max.z, 5.2);
}

TEST(GltfSkins, ScaleWeightsThatDoNotSumToOne) {
  SkinnedTriangle triangle;
  triangle.weights = {2, 0, 0, 0, 0, 0, 0, 0, 0.5, 1.5, 0, 0};
  const Imported imported = triangle.read();
  EXPECT_TRUE(warns(imported, "3 vertices do not sum to one"));
  const std::vector<float> scaled{1, 0, 0, 0, 1, 0, 0, 0, 0.25, 0.75, 0, 0};
  EXPECT_EQ(imported.scene.meshes.at(0).namedAttributes.at(1).values, scaled);
}

TEST(GltfSkins, ThatAreDamagedGiveOneSentenceAndTheMeshAsItWasModelled) {
  const auto expectLeftOut = [](const char* words, auto damage) {
    SkinnedTriangle triangle;
    damage(triangle);
    const Imported imported = triangle.read();
    EXPECT_TRUE(warns(imported, words)) << words << ::testing::PrintToString(imported.warnings);
    EXPECT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
    EXPECT_TRUE(nodesWith<Humanoid>(imported.scene.graph).empty()) << words;
    ASSERT_EQ(nodesWith<Shape>(imported.scene.graph).size(), 1u) << words;
    SkinnedTriangle strict;
    damage(strict);
    ImportOptions options;
    options.strict = true;
    EXPECT_THROW(strict.read(options), Error) << words;
  };
  expectLeftOut("names joint 7 of 2", [](auto& triangle) { triangle.joints[4] = 7; });
  expectLeftOut("negative or not a number", [](auto& triangle) { triangle.weights[0] = notANumber; });
  expectLeftOut("negative or not a number", [](auto& triangle) { triangle.weights[0] = -1; });
  expectLeftOut("of joint 1 is not finite", [](auto& triangle) { triangle.matrices[20] = notANumber; });
  expectLeftOut("of joint 0 is no affine map", [](auto& triangle) { triangle.matrices[3] = 1; });
  expectLeftOut("1 elements of 16 numbers for 2 joints", [](auto& triangle) { triangle.matrices.resize(16); });
  expectLeftOut("names node 8 of 3", [](auto& triangle) { triangle.skin["joints"][1] = 8; });
  expectLeftOut("has no joints", [](auto& triangle) { triangle.skin["joints"] = Json::array(); });
}

/// A triangle with two morph targets.
struct MorphedTriangle {
  GltfText gltf;
  std::vector<float> first{0, 0, 1, 0, 0, 1, 0, 0, 1}, second{2, 0, 0, 0, 0, 0, 0, 0, 0};
  Json mesh{{"weights", {0.25, 0}}, {"extras", {{"targetNames", {"rise", "stretch"}}}}};
  Json node{{"name", "face"}, {"mesh", 0}};

  Imported read(const ImportOptions& options = {}) {
    gltf.addTriangle();
    gltf.json["meshes"][0]["primitives"][0]["targets"] =
        Json::array({{{"POSITION", gltf.addAccessor(first, "VEC3", 5126)}},
                     {{"POSITION", gltf.addAccessor(second, "VEC3", 5126)}}});
    gltf.json["meshes"][0].update(mesh);
    gltf.addNode(node);
    return testing::read(gltf, options);
  }
};

TEST(GltfMorphTargets, BecomeDisplacersOfTheShape) {
  const Imported imported = MorphedTriangle().read();
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::size_t shape = nodesWith<Shape>(graph).at(0);
  ASSERT_EQ(graph.nodes[shape].children.size(), 2u);
  EXPECT_EQ(std::get<Displacer>(graph.nodes[graph.nodes[shape].children[0]].content), (Displacer{"rise", 0.25}));
  EXPECT_EQ(std::get<Displacer>(graph.nodes[graph.nodes[shape].children[1]].content), (Displacer{"stretch", 0}));
  EXPECT_EQ(posedMesh(imported.scene, shape).positions[0], (Vec3f{0, 0, 0.25}));
}

TEST(GltfMorphTargets, HaveTheWeightsOfTheirNode) {
  MorphedTriangle triangle;
  triangle.node["weights"] = {1, 2};
  const Imported imported = triangle.read();
  EXPECT_EQ(posedMesh(imported.scene, nodesWith<Shape>(imported.scene.graph).at(0)).positions[0], (Vec3f{4, 0, 1}));
}

TEST(GltfMorphTargets, AreAnimatedByAScalarInterpolatorEach) {
  MorphedTriangle triangle;
  const std::size_t times = triangle.gltf.addAccessor<float>({0, 2}, "SCALAR", 5126),
                    weights = triangle.gltf.addAccessor<float>({0, 1, 0.5, 3}, "SCALAR", 5126);
  triangle.gltf.json["animations"] =
      Json::array({{{"samplers", {{{"input", times}, {"output", weights}}}},
                    {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}});
  const Imported imported = triangle.read();
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::size_t stretch = nodeNamed(graph, "stretch"), interpolator = nodeNamed(graph, "stretch-weight");
  EXPECT_EQ(std::get<Interpolator>(graph.nodes.at(interpolator).content),
            (Interpolator{InterpolatorKind::scalar, {0, 1}, {1, 3}}));
  EXPECT_EQ(graph.routes.back(), (Route{interpolator, "value_changed", stretch, "weight"}));
  const std::size_t sensor = nodesWith<TimeSensor>(graph).at(0);
  EXPECT_EQ(poseAt(graph, sensor, 0.5).weights.at(stretch), 2);
}

TEST(GltfMorphTargets, ThatAreDamagedAreLeftOutWithOneSentence) {
  const auto expectLeftOut = [](const char* words, auto damage) {
    MorphedTriangle triangle;
    damage(triangle);
    const Imported imported = triangle.read();
    EXPECT_TRUE(warns(imported, words)) << words << ::testing::PrintToString(imported.warnings);
    EXPECT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
    EXPECT_EQ(nodesWith<Shape>(imported.scene.graph).size(), 1u) << words;
  };
  expectLeftOut("has 2 elements of 3 numbers for 3 vertices", [](auto& triangle) { triangle.first.resize(6); });
  expectLeftOut("of vertex 0 is not a number", [](auto& triangle) { triangle.second[1] = notANumber; });
  expectLeftOut("weights", [](auto& triangle) { triangle.mesh["weights"] = {1}; });
}

} // namespace
} // namespace imgeo::testing
