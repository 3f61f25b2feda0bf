#include "scene/nesting.h"

#include "base/error.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace imgeo {

namespace {

/// A node on the path that is being visited.
struct Visit {
  std::size_t node = 0, nextChild = 0;
};

} // namespace

void checkNestingLimit(const SceneGraph& graph, const std::string& location) {
  std::vector<std::size_t> heights(graph.nodes.size()); ///< nodes on the longest path down; 0: not known
  std::vector<Visit> path;
  for (const std::size_t root : graph.roots) {
    path.push_back({root});
    while (!path.empty()) {
      Visit& visit = path.back();
      const std::vector<std::size_t>& children = graph.nodes[visit.node].children;
      if (heights[visit.node] == 0 && visit.nextChild < children.size()) {
        path.push_back({children[visit.nextChild++]});
        continue;
      }
      if (heights[visit.node] == 0) {
        for (const std::size_t child : children)
          heights[visit.node] = std::max(heights[visit.node], heights[child]);
        ++heights[visit.node];
      }
      if (heights[visit.node] > maxNestedNodes)
        throw Error(ErrorKind::limit, location,
                    fmt::format("nodes that USE one another are nested more than {} deep{}", maxNestedNodes,
                                graph.nodes[visit.node].name.empty()
                                    ? ""
                                    : fmt::format(", those below '{}'", graph.nodes[visit.node].name)));
      path.pop_back();
    }
  }
}

} // namespace imgeo
