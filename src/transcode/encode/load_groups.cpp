#include "transcode/encode/load_groups.h"

namespace imgeo {

namespace {

bool isSwitchOrLod(const NodeContent& content) {
  const GenericNode* generic = std::get_if<GenericNode>(&content);
  return generic && (generic->element == "Switch" || generic->element == "LOD");
}

} // namespace

std::vector<std::size_t> loadGroups(const SceneGraph& graph) {
  std::vector<std::size_t> groups(graph.nodes.size());
  std::vector<bool> isKnown(graph.nodes.size());
  std::size_t next = 1;
  for (const std::size_t node : nodesInOrder(graph)) // parents before children
    for (const std::size_t child : graph.nodes[node].children) {
      if (isKnown[child])
        continue; // a USEd node: its first instance counts
      isKnown[child] = true;
      groups[child] = isSwitchOrLod(graph.nodes[node].content) ? next++ : groups[node];
    }
  return groups;
}

} // namespace imgeo
