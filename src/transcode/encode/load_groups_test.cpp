#include "transcode/encode/load_groups.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(LoadGroups, GiveEachChoiceOfASwitchItsOwnGroup) {
  SceneGraph graph;
  const auto add = [&](NodeContent content, std::vector<std::size_t> children) {
    return addNode(graph, {"", std::move(content), std::move(children), "", {}});
  };
  const std::size_t a = add(Shape{}, {}), b = add(Shape{}, {}), c = add(Shape{}, {}), d = add(Shape{}, {});
  const std::size_t near = add(Group{}, {a, b}), levels = add(GenericNode{"LOD", "", {}}, {near, c});
  graph.roots = {levels, d};
  const std::vector<std::size_t> groups = loadGroups(graph);
  EXPECT_EQ(groups[a], groups[b]);
  EXPECT_NE(groups[a], groups[c]);
  EXPECT_NE(groups[c], groups[d]);
  EXPECT_EQ(groups[levels], groups[d]);
}

} // namespace
} // namespace imgeo
