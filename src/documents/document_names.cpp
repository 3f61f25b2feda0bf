#include "documents/document_names.h"

namespace imgeo {

namespace {

/// The requested DEF: `fallback` for an element without a name that is used more than once.
std::string requestedName(const std::string& name, std::size_t uses, const char* fallback) {
  return !name.empty() || uses < 2 ? name : fallback;
}

} // namespace

bool isUse(const Attributes& names) {
  return !names.empty() && names[0].name == "USE";
}

Attributes ElementNames::defOrUse(std::size_t index) {
  if (names_[index].empty())
    return {};
  const bool wasWritten = written_[index];
  written_[index] = true;
  return {{wasWritten ? "USE" : "DEF", names_[index]}};
}

SharedGeometryKey sharedKeyOf(const SceneDocument& document, const Shape& shape) {
  return {document.geometries[shape.mesh].patches[0].data->url, shape.solid};
}

DocumentNames chooseNames(const SceneDocument& document, const std::vector<std::size_t>& roots) {
  const SceneGraph& graph = document.graph;
  DocumentNames names{{},
                      ElementNames(graph.nodes.size()),
                      ElementNames(graph.appearances.size()),
                      ElementNames(graph.textures.size()),
                      ElementNames(2 * document.geometries.size()),
                      {}};
  std::vector<std::size_t> nodeUses(graph.nodes.size()), appearanceUses(graph.appearances.size()),
      textureUses(graph.textures.size()), geometryUses(2 * document.geometries.size());
  const std::vector<std::size_t> order = nodesOfDocument(graph, roots);
  for (const std::size_t root : roots)
    ++nodeUses[root];
  for (const Route& route : graph.routes)
    for (const std::size_t end : {route.fromNode, route.toNode})
      ++nodeUses[end]; // so that it has a DEF
  for (const std::size_t index : order)
    if (const Humanoid* humanoid = std::get_if<Humanoid>(&graph.nodes[index].content))
      for (const std::size_t joint : humanoid->joints)
        nodeUses[joint] += 2;
  for (const std::size_t index : order) {
    if (!inlinesDocument(graph.nodes[index]))
      for (const std::size_t child : graph.nodes[index].children)
        ++nodeUses[child];
    if (const Shape* shape = std::get_if<Shape>(&graph.nodes[index].content)) {
      if (document.geometries[shape->mesh].isShared)
        names.sharedGeometries.try_emplace(sharedKeyOf(document, *shape));
      else
        ++geometryUses.at(2 * shape->mesh + !shape->solid);
      if (shape->appearance && appearanceUses.at(*shape->appearance)++ == 0)
        for (const TextureUse& use : graph.appearances[*shape->appearance].textures)
          ++textureUses.at(use.texture);
    }
  }
  for (const std::size_t index : order) {
    const Node& node = graph.nodes[index];
    names.nodes[index] = names.all.take(requestedName(node.name, nodeUses[index], "shared"));
  }
  for (std::size_t i = 0; i < appearanceUses.size(); ++i)
    if (appearanceUses[i] > 0)
      names.appearances[i] = names.all.take(requestedName(graph.appearances[i].name, appearanceUses[i], "appearance"));
  for (std::size_t i = 0; i < textureUses.size(); ++i)
    names.textures[i] = textureUses[i] < 2 ? "" : names.all.take(requestedName(graph.textures[i].name, 2, "texture"));
  for (std::size_t i = 0; i < geometryUses.size(); ++i)
    names.geometries[i] = geometryUses[i] < 2 ? "" : names.all.take("geometry");
  for (auto& [key, name] : names.sharedGeometries)
    name = names.all.take("g");
  return names;
}

} // namespace imgeo
