#include "scene/scene.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace imgeo {

namespace {

/// Depth-first traversal that visits each node once.
struct Traversal {
  const SceneGraph& graph;
  bool entersInlines = true;
  std::vector<bool> isVisited = std::vector<bool>(graph.nodes.size());
  std::vector<std::size_t> order = {};

  void visit(std::size_t node) {
    if (isVisited[node])
      return;
    isVisited[node] = true;
    order.push_back(node);
    if (entersInlines || !inlinesDocument(graph.nodes[node]))
      for (const std::size_t child : graph.nodes[node].children)
        visit(child);
  }
};

} // namespace

bool hasFrames(const Node& node) {
  const Interpolator* interpolator = std::get_if<Interpolator>(&node.content);
  return interpolator && !interpolator->url.empty();
}

std::size_t addNode(SceneGraph& graph, Node node) {
  graph.nodes.push_back(std::move(node));
  return graph.nodes.size() - 1;
}

std::size_t addRoot(SceneGraph& graph, Node node) {
  graph.roots.push_back(addNode(graph, std::move(node)));
  return graph.roots.back();
}

bool inlinesDocument(const Node& node) {
  const GenericNode* generic = std::get_if<GenericNode>(&node.content);
  return generic && generic->document;
}

const InlinedDocument& inlinedDocumentOf(const SceneGraph& graph, std::size_t node) {
  assert(inlinesDocument(graph.nodes.at(node)));
  return graph.inlined.at(*std::get<GenericNode>(graph.nodes[node].content).document);
}

std::vector<std::size_t> nodesInOrder(const SceneGraph& graph) {
  Traversal traversal{graph};
  for (const std::size_t root : graph.roots)
    traversal.visit(root);
  return std::move(traversal.order);
}

std::vector<std::size_t> nodesOfDocument(const SceneGraph& graph, const std::vector<std::size_t>& roots) {
  Traversal traversal{graph, false};
  for (const std::size_t root : roots)
    traversal.visit(root);
  return std::move(traversal.order);
}

std::span<const std::string_view> imageFieldsOf(std::string_view element) {
  static constexpr std::string_view url[] = {"url"};
  static constexpr std::string_view panorama[] = {"frontUrl", "backUrl", "leftUrl", "rightUrl", "topUrl", "bottomUrl"};
  if (element == "ImageTexture" || element == "ImageCubeMapTexture")
    return url;
  if (element == "Background")
    return panorama;
  return {};
}

std::vector<std::size_t> append(SceneGraph& graph, SceneGraph&& more, std::size_t firstMesh) {
  const std::size_t firstNode = graph.nodes.size(), firstAppearance = graph.appearances.size(),
                    firstTexture = graph.textures.size(), firstImage = graph.images.size(),
                    firstInlined = graph.inlined.size();
  const auto shift = [](auto& index, std::size_t by) {
    if (index)
      *index += by;
  };
  const auto shiftAll = [](std::vector<std::size_t>& indices, std::size_t by) {
    for (std::size_t& index : indices)
      index += by;
  };
  for (Node& node : more.nodes) {
    shiftAll(node.children, firstNode);
    if (Shape* shape = std::get_if<Shape>(&node.content)) {
      shape->mesh += firstMesh;
      shift(shape->appearance, firstAppearance);
    } else if (GenericNode* generic = std::get_if<GenericNode>(&node.content)) {
      for (FieldImage& image : generic->images)
        image.image += firstImage;
      shift(generic->document, firstInlined);
    } else if (Humanoid* humanoid = std::get_if<Humanoid>(&node.content)) {
      shiftAll(humanoid->joints, firstNode);
    }
    graph.nodes.push_back(std::move(node));
  }
  for (Appearance& appearance : more.appearances) {
    for (TextureUse& use : appearance.textures)
      use.texture += firstTexture;
    graph.appearances.push_back(std::move(appearance));
  }
  for (Texture& texture : more.textures) {
    texture.image += firstImage;
    graph.textures.push_back(std::move(texture));
  }
  std::ranges::move(more.images, std::back_inserter(graph.images));
  for (InlinedDocument& document : more.inlined) {
    shiftAll(document.head.header, firstNode);
    graph.inlined.push_back(std::move(document));
  }
  for (Route& route : more.routes) {
    route.fromNode += firstNode;
    route.toNode += firstNode;
    graph.routes.push_back(std::move(route));
  }
  shiftAll(more.roots, firstNode);
  shiftAll(more.head.header, firstNode);
  return std::move(more.roots);
}

std::vector<std::size_t> shapeNodes(const SceneGraph& graph) {
  std::vector<std::size_t> nodes = nodesInOrder(graph);
  std::erase_if(nodes, [&](std::size_t node) { return !std::holds_alternative<Shape>(graph.nodes[node].content); });
  return nodes;
}

const Shape& shapeOf(const SceneGraph& graph, std::size_t node) {
  assert(std::holds_alternative<Shape>(graph.nodes.at(node).content));
  return std::get<Shape>(graph.nodes[node].content);
}

void removeShapes(SceneGraph& graph, const std::vector<bool>& isLeftOut) {
  const auto isRemoved = [&](std::size_t node) {
    const Shape* shape = std::get_if<Shape>(&graph.nodes[node].content);
    return shape && isLeftOut.at(shape->mesh);
  };
  std::erase_if(graph.roots, isRemoved);
  for (Node& node : graph.nodes)
    std::erase_if(node.children, isRemoved);
}

} // namespace imgeo
