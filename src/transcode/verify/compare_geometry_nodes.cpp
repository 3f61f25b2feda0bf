#include "transcode/verify/compare_geometry_nodes.h"

#include "import/x3d/node_table.h"
#include "markup/find_x3d.h"

#include <algorithm>
#include <array>
#include <map>

namespace imgeo {

namespace {

/// X3D's name of a geometry node, whose letters may be in another case; of a node with which X3DOM draws geometry too.
/// Empty for other names.
std::string_view geometryNameOf(std::string_view element) {
  constexpr std::array nodesOfX3dom{std::string_view("BVHRefiner"), std::string_view("ExternalGeometry"),
                                    std::string_view("ExternalShape"), std::string_view("MultiPart"),
                                    std::string_view("PopGeometry")};
  const auto is = [&](std::string_view name) { return equalIgnoringCase(name, element); };
  if (const auto found = std::ranges::find_if(nodesOfX3dom, is); found != nodesOfX3dom.end())
    return *found;
  for (const x3d::NodeRow& row : x3d::nodeTable())
    if (row.containerField == "geometry" && is(row.name))
      return row.name;
  return element.ends_with("Geometry") || element.ends_with("geometry") ? element : std::string_view();
}

using Counts = std::map<std::string, std::size_t, std::less<>>;

Counts countsOf(const std::map<std::string, std::size_t>& elements) {
  Counts counts;
  for (const auto& [element, count] : elements)
    if (const std::string_view name = geometryNameOf(element); !name.empty())
      counts[std::string(name)] += count;
  return counts;
}

std::map<std::string, std::size_t> elementsOf(const SceneGraph& graph) {
  std::map<std::string, std::size_t> elements;
  for (const std::size_t node : nodesInOrder(graph))
    if (const auto* generic = std::get_if<GenericNode>(&graph.nodes[node].content))
      ++elements[generic->element];
  return elements;
}

} // namespace

void compareGeometryNodes(const SceneDocument& site, const SceneGraph& input, Findings& findings) {
  Counts inSite = countsOf(site.otherElements), inInput = countsOf(elementsOf(input));
  for (const auto& [name, count] : inInput)
    inSite.try_emplace(name, 0);
  for (const auto& [name, count] : inSite)
    if (const std::size_t expected = inInput[name]; count != expected)
      findings.add("The site has {} {} {}, the input {}.", count, name, count == 1 ? "node" : "nodes", expected);
}

} // namespace imgeo
