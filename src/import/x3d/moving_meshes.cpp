#include "import/x3d/moving_meshes.h"

#include <algorithm>

namespace imgeo::x3d {

MovingMeshes::MovingMeshes(SceneGraph& graph, const std::vector<RecordedMesh>& meshes,
                           std::map<std::string, std::size_t>& defined)
    : graph_(graph) {
  if (meshes.empty())
    return;
  std::map<std::size_t, std::size_t> shapeOfMesh;
  for (const std::size_t node : shapeNodes(graph))
    shapeOfMesh.try_emplace(shapeOf(graph, node).mesh, node);
  for (const RecordedMesh& mesh : meshes) {
    if (const auto shape = shapeOfMesh.find(mesh.mesh); shape != shapeOfMesh.end())
      add(mesh, shape->second, defined);
    for (const pugi::xml_node& node : mesh.replaced)
      if (node && !defined.contains(node.attribute("DEF").value())) // a geometry that stays text may have it, too
        replaced_.insert(node.internal_object());
  }
}

void MovingMeshes::add(const RecordedMesh& mesh, std::size_t shape, std::map<std::string, std::size_t>& defined) {
  const auto& [coordinateDef, normalDef, coordinates, normals] = mesh.moving;
  const auto addChild = [&](const std::string& def, const Interpolator& content) {
    const std::size_t child = addNode(graph_, {def, content, {}, ""});
    graph_.nodes[shape].children.push_back(child);
    if (const auto found = defined.find(def); found != defined.end())
      copiesOf_[found->second].push_back(child);
    else if (!def.empty()) {
      defined[def] = child;
      sequences_.insert(def);
    }
  };
  addChild(coordinateDef, coordinates);
  if (!normals.keys.empty())
    addChild(normalDef, normals);
}

void MovingMeshes::finish() {
  std::vector<Route> further;
  for (const Route& route : graph_.routes)
    if (const auto copies = copiesOf_.find(route.toNode); copies != copiesOf_.end())
      for (const std::size_t copy : copies->second)
        further.push_back({route.fromNode, route.fromField, copy, route.toField});
  const auto isReplaced = [&](std::size_t node) {
    return copiesOf_.contains(node) &&
           std::ranges::none_of(graph_.routes, [&](const Route& route) { return route.fromNode == node; });
  };
  std::set<std::size_t> replaced;
  for (const auto& [node, copies] : copiesOf_)
    if (isReplaced(node))
      replaced.insert(node);
  const auto isGone = [&](std::size_t node) { return replaced.contains(node); };
  std::erase_if(graph_.routes, [&](const Route& route) { return isGone(route.toNode); });
  std::ranges::copy(further, std::back_inserter(graph_.routes));
  std::erase_if(graph_.roots, isGone);
  for (Node& node : graph_.nodes)
    std::erase_if(node.children, isGone);
}

} // namespace imgeo::x3d
