#include "scene/nesting.h"

#include "base/error.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

/// A chain of Groups, each of which has the one before as its only child, all of them roots.
SceneGraph chainOf(std::size_t nodes) {
  SceneGraph graph;
  graph.roots.push_back(addNode(graph, {"", Shape{}, {}, ""}));
  while (graph.roots.size() < nodes)
    graph.roots.push_back(addNode(graph, {"", Group{}, {graph.roots.back()}, ""}));
  return graph;
}

TEST(Nesting, IsLimitedThroughUses) {
  EXPECT_NO_THROW(checkNestingLimit(chainOf(maxNestedNodes), "a.x3d"));
  SceneGraph graph = chainOf(maxNestedNodes + 1);
  EXPECT_THROW(checkNestingLimit(graph, "a.x3d"), Error);
  graph.roots = {graph.roots.back()};
  EXPECT_THROW(checkNestingLimit(graph, "a.x3d"), Error);
}

TEST(Nesting, OfManyNodesIsFoundWithoutRecursion) {
  SceneGraph graph = chainOf(300'000);
  graph.roots = {graph.roots.back()};
  EXPECT_THROW(checkNestingLimit(graph, "a.x3d"), Error);
}

TEST(Nesting, OfNodesThatAreUsedOftenIsVisitedOnce) {
  SceneGraph graph;
  std::size_t node = addNode(graph, {"", Shape{}, {}, ""});
  for (int level = 0; level < 100; ++level)
    node = addNode(graph, {"", Group{}, {node, node}, ""});
  graph.roots = {node};
  EXPECT_NO_THROW(checkNestingLimit(graph, "a.x3d"));
}

} // namespace
} // namespace imgeo
