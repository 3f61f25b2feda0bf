#include "scene/scene.h"

#include "base/error.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>

namespace imgeo {

namespace {

constexpr std::size_t maxPlacedShapes = 1'000'000;

/// Lists nodes in the order of their first mention.
struct Visit {
  const SceneGraph& graph;
  bool entersInlines = true;
  std::vector<bool> seen = std::vector<bool>(graph.nodes.size());
  std::vector<std::size_t> order = {};

  void visit(std::size_t node) {
    if (seen[node])
      return;
    seen[node] = true;
    order.push_back(node);
    if (entersInlines || !showsDocument(graph.nodes[node]))
      for (const std::size_t child : graph.nodes[node].children)
        visit(child);
  }
};

[[noreturn]] void failOfPlaces(const std::string& where) {
  throw Error(ErrorKind::limit, where, "the scene shows more than a million shapes");
}

/// Counts shapes in all their places, as far as there may be: each node is looked at once.
class PlaceCount {
public:
  explicit PlaceCount(const SceneGraph& graph) : graph_(graph), counts_(graph.nodes.size()) {}

  std::size_t below(const std::vector<std::size_t>& nodes) {
    std::size_t sum = 0;
    for (const std::size_t node : nodes)
      sum = std::min(sum + at(node), maxPlacedShapes + 1);
    return sum;
  }

private:
  std::size_t at(std::size_t index) {
    if (counts_[index])
      return *counts_[index];
    const Node& node = graph_.nodes[index];
    const OtherNode* other = std::get_if<OtherNode>(&node.content);
    const bool isShape = std::holds_alternative<Shape>(node.content) || (other && other->element == "Shape");
    const std::size_t count = isShape ? 1 : below(node.children);
    counts_[index] = count;
    return count;
  }

  const SceneGraph& graph_;
  std::vector<std::optional<std::size_t>> counts_;
};

/// Lists the places of the shapes below a node. Nodes below which there are none
/// are visited once, however often they are USEd.
class Placing {
public:
  Placing(const SceneGraph& graph, const std::string& where)
      : graph_(graph), where_(where), isBare_(graph.nodes.size()) {}

  void place(std::size_t index, const Affine3d& worldFromParent) {
    if (isBare_[index])
      return;
    const Node& node = graph_.nodes[index];
    if (std::holds_alternative<Shape>(node.content)) {
      if (placed.size() == maxPlacedShapes)
        failOfPlaces(where_);
      placed.push_back({index, worldFromParent});
      return;
    }
    const std::size_t before = placed.size();
    const Transform* transform = std::get_if<Transform>(&node.content);
    const Affine3d worldFromNode = transform ? worldFromParent * affineOf(*transform) : worldFromParent;
    for (const std::size_t child : node.children)
      place(child, worldFromNode);
    isBare_[index] = placed.size() == before;
  }

  std::vector<PlacedShape> placed;

private:
  const SceneGraph& graph_;
  const std::string& where_;
  std::vector<bool> isBare_;
};

} // namespace

std::size_t addNode(SceneGraph& graph, Node node) {
  graph.nodes.push_back(std::move(node));
  return graph.nodes.size() - 1;
}

std::size_t addRoot(SceneGraph& graph, Node node) {
  graph.roots.push_back(addNode(graph, std::move(node)));
  return graph.roots.back();
}

bool showsDocument(const Node& node) {
  const OtherNode* other = std::get_if<OtherNode>(&node.content);
  return other && other->document;
}

const InlinedDocument& inlinedDocumentOf(const SceneGraph& graph, std::size_t node) {
  assert(showsDocument(graph.nodes.at(node)));
  return graph.inlined.at(*std::get<OtherNode>(graph.nodes[node].content).document);
}

std::vector<std::size_t> nodesInOrder(const SceneGraph& graph) {
  Visit visit{graph};
  for (const std::size_t root : graph.roots)
    visit.visit(root);
  return std::move(visit.order);
}

std::vector<std::size_t> nodesOfDocument(const SceneGraph& graph, const std::vector<std::size_t>& roots) {
  Visit visit{graph, false};
  for (const std::size_t root : roots)
    visit.visit(root);
  return std::move(visit.order);
}

std::vector<std::size_t> append(SceneGraph& graph, SceneGraph&& more, std::size_t meshesBefore) {
  const std::size_t nodes = graph.nodes.size(), appearances = graph.appearances.size(),
                    textures = graph.textures.size(), images = graph.images.size(), inlined = graph.inlined.size();
  const auto shift = [](auto& index, std::size_t by) {
    if (index)
      *index += by;
  };
  const auto shiftAll = [](std::vector<std::size_t>& indices, std::size_t by) {
    for (std::size_t& index : indices)
      index += by;
  };
  for (Node& node : more.nodes) {
    shiftAll(node.children, nodes);
    if (Shape* shape = std::get_if<Shape>(&node.content)) {
      shape->mesh += meshesBefore;
      shift(shape->appearance, appearances);
    } else if (OtherNode* other = std::get_if<OtherNode>(&node.content)) {
      shift(other->image, images);
      shift(other->document, inlined);
    }
    graph.nodes.push_back(std::move(node));
  }
  for (Appearance& appearance : more.appearances) {
    for (TextureUse& use : appearance.textures)
      use.texture += textures;
    graph.appearances.push_back(std::move(appearance));
  }
  for (Texture& texture : more.textures) {
    texture.image += images;
    graph.textures.push_back(std::move(texture));
  }
  std::ranges::move(more.images, std::back_inserter(graph.images));
  for (InlinedDocument& document : more.inlined) {
    shiftAll(document.head.header, nodes);
    graph.inlined.push_back(std::move(document));
  }
  shiftAll(more.roots, nodes);
  shiftAll(more.head.header, nodes);
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
  const auto leavesOut = [&](std::size_t node) {
    const Shape* shape = std::get_if<Shape>(&graph.nodes[node].content);
    return shape && isLeftOut.at(shape->mesh);
  };
  std::erase_if(graph.roots, leavesOut);
  for (Node& node : graph.nodes)
    std::erase_if(node.children, leavesOut);
}

void requireCountableShapes(const SceneGraph& graph, const std::string& location) {
  if (PlaceCount(graph).below(graph.roots) > maxPlacedShapes)
    failOfPlaces(location);
}

std::vector<PlacedShape> placedShapes(const SceneGraph& graph, const std::string& location) {
  Placing placing(graph, location);
  for (const std::size_t root : graph.roots)
    placing.place(root, {});
  return std::move(placing.placed);
}

Viewpoint viewpointFor(const Box3d& box) {
  Viewpoint viewpoint;
  viewpoint.description = "Start";

  // Turn the default view (along -z) by `yaw` to the side, then look down by `pitch`.
  const double yaw = 0.45, pitch = -0.3;
  const double cy = std::cos(yaw / 2), sy = std::sin(yaw / 2), cp = std::cos(pitch / 2), sp = std::sin(pitch / 2);
  const Vec3d axis{cy * sp, sy * cp, -sy * sp}; // quaternion yaw * pitch
  const double axisLength = length(axis);
  viewpoint.orientation = {axis * (1 / axisLength), 2 * std::atan2(axisLength, cy * cp)};

  const Vec3d right{std::cos(yaw), 0, -std::sin(yaw)};
  const Vec3d back{std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
  const Vec3d up = cross(back, right);

  // As near as all corners of the box are seen, with a margin around them.
  const double widest = 0.9 * std::tan(viewpoint.fieldOfView / 2);
  const Vec3d half = box.size() * 0.5;
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3d c{corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z};
    const double aside = std::max(std::abs(dot(c, right)), std::abs(dot(c, up)));
    distance = std::max(distance, dot(c, back) + aside / widest);
  }
  if (distance == 0)
    distance = 1; // a single point
  viewpoint.centerOfRotation = box.center();
  viewpoint.position = box.center() + back * distance;
  return viewpoint;
}

} // namespace imgeo
