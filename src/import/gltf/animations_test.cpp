#include "base/testing.h"
#include "import/gltf/testing.h"
#include "import/testing.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace imgeo::testing {
namespace {

/// A triangle whose node has one animated field.
struct AnimatedTriangle {
  GltfText gltf;
  GltfText::Json samplers = GltfText::Json::array(), channels = GltfText::Json::array();

  AnimatedTriangle() { gltf.addNode({{"name", "door"}, {"mesh", gltf.addTriangle()}}); }

  AnimatedTriangle& add(const char* path, const std::vector<float>& seconds, const std::vector<float>& values,
                        const char* interpolation = "LINEAR") {
    const std::string type = path == std::string("rotation") ? "VEC4" : "VEC3";
    const std::size_t input = gltf.addAccessor<float>(seconds, "SCALAR", 5126),
                      output = gltf.addAccessor<float>(values, type, 5126);
    samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
    channels.push_back({{"sampler", samplers.size() - 1}, {"target", {{"node", 0}, {"path", path}}}});
    return *this;
  }

  Imported read(const ImportOptions& options = {}) {
    gltf.json["animations"] = GltfText::Json::array();
    gltf.json["animations"].push_back({{"name", "open"}, {"samplers", samplers}, {"channels", channels}});
    return testing::read(gltf, options);
  }
};

std::size_t indexOf(const SceneGraph& graph, const std::string& name) {
  return static_cast<std::size_t>(std::ranges::find(graph.nodes, name, &Node::name) - graph.nodes.begin());
}

const Interpolator& interpolatorNamed(const SceneGraph& graph, const std::string& name) {
  return std::get<Interpolator>(graph.nodes.at(indexOf(graph, name)).content);
}

/// The value of an interpolator at a fraction, component by component.
std::vector<double> linearValueAt(const Interpolator& interpolator, double fraction) {
  const std::size_t count = componentsOf(interpolator.kind);
  std::size_t after = 1;
  while (after + 1 < interpolator.keys.size() && interpolator.keys[after] < fraction)
    ++after;
  const double from = interpolator.keys[after - 1], to = interpolator.keys[after];
  std::vector<double> value;
  for (std::size_t c = 0; c < count; ++c)
    value.push_back(std::lerp(interpolator.values[(after - 1) * count + c], interpolator.values[after * count + c],
                              to > from ? (fraction - from) / (to - from) : 1));
  return value;
}

TEST(GltfAnimations, OfPointersToTransformsOfNodesAreLikeThoseOfNodes) {
  AnimatedTriangle plain, pointed;
  for (AnimatedTriangle* each : {&plain, &pointed})
    each->add("rotation", {0, 2}, {0, 0, 0, 1, 0, 0, std::sqrt(0.5f), std::sqrt(0.5f)});
  const auto point = [&](const char* pointer) {
    pointed.channels[0]["target"] = {{"path", "pointer"},
                                     {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
  };
  point("/nodes/0/rotation");
  const Imported imported = pointed.read();
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  EXPECT_EQ(interpolatorNamed(imported.scene.graph, "door-rotation"),
            interpolatorNamed(plain.read().scene.graph, "door-rotation"));
  point("/nodes/7/rotation");
  EXPECT_NE(pointed.read().warnings.at(0).find("names node 7 of 1"), std::string::npos);
  for (const char* other : {"/materials/0/pbrMetallicRoughness/baseColorFactor", "/nodes//scale",
                            "/nodes/99999999999999999999/scale", "/nodes/0"}) {
    point(other);
    EXPECT_EQ(pointed.read().warnings,
              std::vector<std::string>{
                  "1 animated property is not carried over: only transforms of nodes and weights of morph "
                  "targets are animated."})
        << other;
  }
}

TEST(GltfAnimations, BecomeATimeSensorInterpolatorsAndRoutes) {
  const Imported imported = AnimatedTriangle()
                                .add("translation", {0, 1, 4}, {0, 0, 0, 1, 2, 3, 0, 0, 0})
                                .add("rotation", {1, 2}, {0, 0, 0, 1, 0, 0, -std::sqrt(0.5f), -std::sqrt(0.5f)})
                                .read();
  EXPECT_TRUE(imported.warnings.empty()) << ::testing::PrintToString(imported.warnings);
  const SceneGraph& graph = imported.scene.graph;
  const std::size_t door = indexOf(graph, "door"), sensor = indexOf(graph, "open");
  EXPECT_EQ(std::get<Transform>(graph.nodes.at(door).content), Transform{}) << "an identity that moves stays";
  EXPECT_EQ(std::get<TimeSensor>(graph.nodes.at(sensor).content), (TimeSensor{.cycleInterval = 4, .loop = true}));
  EXPECT_EQ(interpolatorNamed(graph, "door-translation"),
            (Interpolator{InterpolatorKind::position, {0, 0.25, 1}, {0, 0, 0, 1, 2, 3, 0, 0, 0}}));
  const Interpolator& rotation = interpolatorNamed(graph, "door-rotation");
  EXPECT_EQ(rotation.keys, (std::vector<float>{0.25, 0.5}));
  ASSERT_EQ(rotation.values.size(), 8u);
  EXPECT_EQ(rotation.values[6], 1);
  EXPECT_NEAR(rotation.values[7], std::numbers::pi / 2, 1e-6);
  const std::size_t translation = indexOf(graph, "door-translation"), turn = indexOf(graph, "door-rotation");
  EXPECT_EQ(graph.routes, (std::vector<Route>{{sensor, "fraction_changed", translation, "set_fraction"},
                                              {translation, "value_changed", door, "translation"},
                                              {sensor, "fraction_changed", turn, "set_fraction"},
                                              {turn, "value_changed", door, "rotation"}}));
}

TEST(GltfAnimations, OfStepsHaveTwoKeysForEach) {
  const Imported imported = AnimatedTriangle().add("scale", {0, 1, 2}, {1, 1, 1, 2, 2, 2, 3, 3, 3}, "STEP").read();
  EXPECT_EQ(
      interpolatorNamed(imported.scene.graph, "door-scale"),
      (Interpolator{InterpolatorKind::position, {0, 0.5, 0.5, 1, 1}, {1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 3, 3, 3}}));
}

TEST(GltfAnimations, OfSplinesAreResampledWithinTheStatedError) {
  // From 0 to 8 along x, with slopes 6 and 0, and out to the side and back.
  const std::vector<float> values{0, 0, 0, 0, 0, 0, 6, 5, 0, 0, -5, 0, 8, 0, 0, 0, 0, 0};
  const Imported imported = AnimatedTriangle().add("translation", {0, 2}, values, "CUBICSPLINE").read();
  const Interpolator& interpolator = interpolatorNamed(imported.scene.graph, "door-translation");
  EXPECT_LT(interpolator.keys.size(), 200u);
  for (int i = 0; i <= 1000; ++i) {
    const double t = i / 1000.0, t2 = t * t, t3 = t2 * t;
    const double out = 2 * (t3 - 2 * t2 + t), in = 2 * (t3 - t2);
    const std::vector<double> value = linearValueAt(interpolator, t);
    EXPECT_NEAR(value[0], 6 * out + 8 * (3 * t2 - 2 * t3), 6e-4 * 8) << t;
    EXPECT_NEAR(value[1], 5 * out - 5 * in, 6e-4 * 8) << t;
  }
}

TEST(GltfAnimations, ThatAreMalformedAreLeftOutOrRefusedIfStrict) {
  const auto expect = [](AnimatedTriangle animated, const std::string& fault) {
    const Imported imported = animated.read();
    ASSERT_EQ(imported.warnings.size(), 1u) << fault;
    EXPECT_NE(imported.warnings[0].find(fault), std::string::npos) << imported.warnings[0];
    EXPECT_TRUE(imported.scene.graph.routes.empty());
    ImportOptions strict;
    strict.strict = true;
    EXPECT_THROW(animated.read(strict), Error);
  };
  const float nan = std::nanf("");
  expect(AnimatedTriangle().add("scale", {0, 0}, {1, 1, 1, 2, 2, 2}), "time 1 is not later than the one before");
  expect(AnimatedTriangle().add("scale", {nan}, {1, 1, 1}), "time 0 is not later");
  expect(AnimatedTriangle().add("scale", {0}, {1, nan, 1}), "value 0 is not finite");
  expect(AnimatedTriangle().add("scale", {0}, {1, 1, 1, 2, 2, 2}), "holds 2 values of 3 numbers for 1 keys");
  expect(AnimatedTriangle().add("translation", {0}, {1, 1, 1}, "BEZIER"), "is none of LINEAR, STEP and CUBICSPLINE");
  AnimatedTriangle fixed;
  fixed.gltf.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  expect(fixed.add("scale", {0}, {1, 1, 1}), "names a node with a matrix");
}

TEST(GltfAnimations, BesideTheFirstDoNotPlayByThemselves) {
  AnimatedTriangle animated;
  animated.add("scale", {0, 1}, {1, 1, 1, 2, 2, 2}).read();
  animated.gltf.json["animations"].push_back(animated.gltf.json["animations"][0]);
  const SceneGraph graph = read(animated.gltf).scene.graph;
  EXPECT_TRUE(std::get<TimeSensor>(graph.nodes.at(indexOf(graph, "open")).content).enabled);
  EXPECT_FALSE(std::get<TimeSensor>(graph.nodes.at(indexOf(graph, "open-2")).content).enabled);
}

} // namespace
} // namespace imgeo::testing
