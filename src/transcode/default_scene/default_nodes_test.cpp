#include "transcode/default_scene/default_nodes.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <variant>

namespace imgeo {
namespace {

SceneDocument documentWith(const NodeContent& content) {
  SceneDocument document;
  const std::size_t group = addRoot(document.graph, {"", Group{}, {}, ""});
  const std::size_t node = addNode(document.graph, {"", content, {}, ""});
  document.graph.nodes[group].children.push_back(node);
  return document;
}

std::size_t lightsAddedTo(SceneDocument& document) {
  const auto count = [&] {
    return std::ranges::count_if(document.graph.nodes, [](const Node& node) {
      return std::holds_alternative<DirectionalLight>(node.content) ||
             std::holds_alternative<PointLight>(node.content) || std::holds_alternative<SpotLight>(node.content);
    });
  };
  const auto before = count();
  std::vector<std::string> warnings;
  addDefaultNodes(document, StartView::automatic, {}, warnings);
  EXPECT_TRUE(warnings.empty());
  return static_cast<std::size_t>(count() - before);
}

TEST(DefaultNodes, AddNoLightAndNoHeadlightToASourceWithALightThatShines) {
  SpotLight faint;
  faint.intensity = 0.01f;
  faint.color = {0, 0, 0.1f};
  for (const NodeContent& light : {NodeContent(DirectionalLight{}), NodeContent(PointLight{}), NodeContent(faint)}) {
    SceneDocument document = documentWith(light);
    EXPECT_EQ(lightsAddedTo(document), 0u);
    EXPECT_FALSE(document.graph.headlight);
  }
}

TEST(DefaultNodes, LightASourceWhoseLightsDoNotShine) {
  PointLight dark, black;
  dark.intensity = 0;
  black.color = {0, 0, 0};
  for (const NodeContent& content : {NodeContent(Group{}), NodeContent(dark), NodeContent(black)}) {
    SceneDocument document = documentWith(content);
    EXPECT_EQ(lightsAddedTo(document), 2u);
    EXPECT_TRUE(document.graph.headlight);
  }
}

} // namespace
} // namespace imgeo
