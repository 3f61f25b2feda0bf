#include "scene/scene.h"

#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(RemoveShapes, KeepsAllOtherNodes) {
  SceneGraph graph;
  const std::size_t kept = addRoot(graph, {"", Shape{1, {}, true}, {}, ""});
  const std::size_t removed = addRoot(graph, {"", Shape{0, {}, true}, {}, ""});
  const std::size_t group = addRoot(graph, {"", Group{}, {removed, kept, removed}, ""});
  removeShapes(graph, {true, false});
  EXPECT_EQ(graph.roots, (std::vector<std::size_t>{kept, group}));
  EXPECT_EQ(graph.nodes[group].children, std::vector<std::size_t>{kept});
}

} // namespace
} // namespace imgeo
