#include "import/testing.h"
#include "scene/deformation.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo::x3d {
namespace {

struct JointText {
  std::string indices, weights;
};

/// A humanoid at x = 10 with the joints "hip" and, below it, "knee" with its centre at y = 1. The skin is a triangle of
/// the points (0, 0, 0), (0, 2, 0) and (1, 2, 0).
std::string humanoid(const JointText& hip, const JointText& knee, const std::string& fields = "") {
  const auto joint = [](const std::string& name, const JointText& text, const std::string& more) {
    return "<HAnimJoint DEF='" + name + "' skinCoordIndex='" + text.indices + "' skinCoordWeight='" + text.weights +
           "' " + more + ">";
  };
  return "<HAnimHumanoid DEF='H' translation='10 0 0' " + fields +
         "><Coordinate DEF='C' containerField='skinCoord' point='0 0 0  0 2 0  1 2 0'/>" +
         joint("hip", hip, "containerField='skeleton'") + joint("knee", knee, "center='0 1 0'") +
         "</HAnimJoint></HAnimJoint><HAnimJoint USE='hip' containerField='joints'/><HAnimJoint USE='knee' "
         "containerField='joints'/><Shape containerField='skin'><IndexedTriangleSet index='0 1 2' solid='false'>"
         "<Coordinate USE='C'/></IndexedTriangleSet></Shape></HAnimHumanoid>";
}

Imported readHumanoid(const std::string& nodes, bool strict = false) {
  ImportOptions options;
  options.strict = strict;
  return importBytes(asBytes("<X3D><Scene>" + nodes + "</Scene></X3D>"), "a.x3d", options);
}

std::size_t indexOfNode(const SceneGraph& graph, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(graph.nodes, name, &Node::name) - graph.nodes.begin());
}

/// The points of the only shape while the knee is turned by a quarter about z.
std::vector<Vec3f> pointsWithBentKnee(const Scene& scene) {
  const std::size_t knee = indexOfNode(scene.graph, "knee");
  Pose pose;
  pose.transforms[knee] = std::get<Transform>(scene.graph.nodes.at(knee).content);
  pose.transforms[knee].rotation = {{0, 0, 1}, std::numbers::pi / 2};
  return posedMesh(scene, shapeNodes(scene.graph).at(0), pose).positions;
}

void expectNear(const std::vector<Vec3f>& points, const std::vector<Vec3f>& expected) {
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_LT(length(Vec3d(points[i]) - Vec3d(expected[i])), 1e-6) << i;
}

TEST(HAnimSkins, FollowTheJointsThatNameTheirPoints) {
  const Imported imported = readHumanoid(humanoid({"0 2", "1 0.5"}, {"1 2", "1 0.5"}));
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const Scene& scene = imported.scene;
  EXPECT_EQ(posedMesh(scene, shapeNodes(scene.graph).at(0)).positions, scene.meshes.at(0).positions) << "at rest";
  // About (0, 1, 0): (0, 2, 0) turns to (-1, 1, 0), and (1, 2, 0) to (-1, 2, 0), of which half counts.
  expectNear(pointsWithBentKnee(scene), {{0, 0, 0}, {-1, 1, 0}, {0, 2, 0}});
}

TEST(HAnimSkins, RestWithWhatIsMissingFromTheSumOfTheWeights) {
  const Imported imported = readHumanoid(humanoid({"", ""}, {"1 2", "1 0.5"}));
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  expectNear(pointsWithBentKnee(imported.scene), {{0, 0, 0}, {-1, 1, 0}, {0, 2, 0}});
}

TEST(HAnimSkins, MayBeModelledInAnotherPose) {
  const Imported imported = readHumanoid(
      humanoid({"0", "1"}, {"1 2", "1 1"}, "jointBindingPositions='0 0 0  0 0 5' jointBindingScales='1 1 1  2 2 2'"));
  const Mesh mesh = posedMesh(imported.scene, shapeNodes(imported.scene.graph).at(0));
  expectNear(mesh.positions, {{0, 0, 0}, {0, 4, 5}, {2, 4, 5}});
}

TEST(HAnimSkins, AreChildrenOfTheHumanoidsTransformBehindItsSkeleton) {
  const SceneGraph graph = readHumanoid(humanoid({"0 1 2", "1 1 1"}, {"", ""})).scene.graph;
  const Node& transform = graph.nodes.at(graph.roots.at(0));
  EXPECT_EQ(transform.name, "H");
  EXPECT_EQ(std::get<Transform>(transform.content).translation, (Vec3d{10, 0, 0}));
  ASSERT_EQ(transform.children.size(), 2u);
  EXPECT_TRUE(std::get<Transform>(graph.nodes[transform.children[0]].content).isJoint);
  const Humanoid& humanoid = std::get<Humanoid>(graph.nodes[transform.children[1]].content);
  EXPECT_EQ(humanoid.joints, (std::vector{indexOfNode(graph, "hip"), indexOfNode(graph, "knee")}));
}

TEST(HAnimSkins, IgnoreWrongIndicesAndWeightsWithOneWarningForAJoint) {
  const auto expect = [](const JointText& knee, const std::string& warning) {
    const std::string scene = humanoid({"0 1 2", "1 1 1"}, knee);
    const Imported imported = readHumanoid(scene);
    ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
    EXPECT_TRUE(imported.warnings[0].ends_with(": HAnimJoint \"knee\": " + warning + ".")) << imported.warnings[0];
    EXPECT_TRUE(imported.warnings[0].starts_with("a.x3d:1:")) << imported.warnings[0];
    EXPECT_EQ(shapeNodes(imported.scene.graph).size(), 1u);
    EXPECT_THROW(readHumanoid(scene, true), Error);
  };
  expect({"1 2", "1"}, "skinCoordIndex has 2 numbers and skinCoordWeight 1: only the first 1 of both count");
  expect({"1", "x"}, "skinCoordWeight holds something that is no number and has no effect");
  const std::string points =
      "of its points are not among the 3 of skinCoord, or have a weight below 0 or above 1000000";
  expect({"-1 3 0.5 1", "1 1 1 1"}, "3 " + points);
  expect({"1", "-0.5"}, "1 " + points);
}

TEST(HAnimSkins, KeepTheEightLargestWeightsOfAPoint) {
  std::string joints, uses;
  for (int i = 0; i < 10; ++i) {
    const std::string name = "j" + std::to_string(i);
    joints += "<HAnimJoint DEF='" + name + "' containerField='skeleton' skinCoordIndex='0 1 2' skinCoordWeight='" +
              (i < 2 ? "0.01 0.1 0.1" : "0.1225 0.1 0.1") + "'/>";
    uses += "<HAnimJoint USE='" + name + "' containerField='joints'/>";
  }
  const Imported imported =
      readHumanoid("<HAnimHumanoid><Coordinate DEF='C' containerField='skinCoord' point='0 0 0 1 0 0 "
                   "0 1 0'/>" +
                   joints + uses +
                   "<Shape containerField='skin'><TriangleSet><Coordinate USE='C'/></TriangleSet>"
                   "</Shape></HAnimHumanoid>");
  ASSERT_EQ(imported.warnings.size(), 1u) << ::testing::PrintToString(imported.warnings);
  EXPECT_TRUE(imported.warnings[0].ends_with(": 3 of its points have more than 8 joints: the largest weights count."));
  EXPECT_EQ(jointSetCount(imported.scene.meshes.at(0)), 2u);
}

} // namespace
} // namespace imgeo::x3d
