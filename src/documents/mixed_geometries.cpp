#include "documents/mixed_geometries.h"

#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace imgeo {

void splitMixedGeometries(SceneDocument& document) {
  std::vector<GeometryDescription>& geometries = document.geometries;
  std::map<std::size_t, std::vector<std::size_t>> parts; ///< by the geometry that they replace
  for (std::size_t i = 0, count = geometries.size(); i < count; ++i) {
    if (!drawsSeveralTopologies(geometries[i]))
      continue;
    parts[i] = {i};
    std::vector<GeometryDescription> split = splitByTopology(geometries[i]);
    geometries[i] = std::move(split[0]);
    for (std::size_t part = 1; part < split.size(); ++part) {
      parts[i].push_back(geometries.size());
      geometries.push_back(std::move(split[part]));
    }
  }
  if (parts.empty())
    return;
  for (const std::size_t node : shapeNodes(document.graph)) {
    const auto found = parts.find(shapeOf(document.graph, node).mesh);
    if (found == parts.end())
      continue;
    Shape shape = shapeOf(document.graph, node);
    Node copy = document.graph.nodes[node];
    Node group{std::exchange(copy.name, {}), Group{}, {}, std::exchange(copy.extras, {})};
    for (const std::size_t part : found->second) {
      shape.mesh = part;
      copy.content = shape;
      group.children.push_back(addNode(document.graph, copy));
    }
    document.graph.nodes[node] = std::move(group);
  }
}

} // namespace imgeo
