#include "transcode/picture/generic_fields.h"

#include "import/x3d/field_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace imgeo {

namespace {

std::string_view elementOf(const Node& node) {
  const GenericNode* generic = std::get_if<GenericNode>(&node.content);
  return generic ? std::string_view(generic->element) : std::string_view();
}

/// The pose that Viewpoint and OrthoViewpoint share.
Viewpoint poseOf(const Node& node) {
  Viewpoint viewpoint;
  std::array position{viewpoint.position.x, viewpoint.position.y, viewpoint.position.z};
  readNumbers(node, "position", position);
  viewpoint.position = {position[0], position[1], position[2]};
  std::array rotation{0.0, 0.0, 1.0, 0.0};
  readNumbers(node, "orientation", rotation);
  viewpoint.orientation = {{rotation[0], rotation[1], rotation[2]}, rotation[3]};
  return viewpoint;
}

/// The angle in which a rectangle of half its shorter edge is seen from the distance of the position to the origin.
double fieldOfViewFor(double halfEdge, Vec3d position) {
  const double distance = length(position);
  return distance > 0 ? 2 * std::atan(halfEdge / distance) : Viewpoint().fieldOfView;
}

} // namespace

const std::string* fieldOf(const Node& node, std::string_view name) {
  const auto field = std::ranges::find(node.fields, name, &FieldText::name);
  return field == node.fields.end() ? nullptr : &field->value;
}

void readNumbers(const Node& node, std::string_view name, std::span<double> values) {
  if (const std::string* text = fieldOf(node, name))
    if (const std::optional<std::vector<double>> numbers = x3d::parseReals(*text))
      std::copy_n(numbers->begin(), std::min(numbers->size(), values.size()), values.begin());
}

bool isChildNode(const Node& node) {
  const std::string_view element = elementOf(node);
  return element != commentElement && !element.starts_with("Metadata");
}

std::optional<Viewpoint> viewpointOf(const Node& node) {
  if (const Viewpoint* viewpoint = std::get_if<Viewpoint>(&node.content))
    return *viewpoint;
  if (const OrthoViewpoint* ortho = std::get_if<OrthoViewpoint>(&node.content)) {
    Viewpoint viewpoint;
    viewpoint.position = ortho->position;
    viewpoint.orientation = ortho->orientation;
    const double halfEdge = std::min(ortho->max.x - ortho->min.x, ortho->max.y - ortho->min.y) / 2;
    viewpoint.fieldOfView = fieldOfViewFor(halfEdge, ortho->position);
    return viewpoint;
  }
  if (elementOf(node) == "Viewpoint") {
    Viewpoint viewpoint = poseOf(node);
    readNumbers(node, "fieldOfView", {&viewpoint.fieldOfView, 1});
    return viewpoint;
  }
  if (elementOf(node) == "OrthoViewpoint") {
    Viewpoint viewpoint = poseOf(node);
    std::array rectangle{-1.0, -1.0, 1.0, 1.0};
    readNumbers(node, "fieldOfView", rectangle);
    const double halfEdge = std::min(rectangle[2] - rectangle[0], rectangle[3] - rectangle[1]) / 2;
    viewpoint.fieldOfView = fieldOfViewFor(halfEdge, viewpoint.position);
    return viewpoint;
  }
  return std::nullopt;
}

namespace {

std::optional<Vec3f> firstSkyColor(const SceneGraph& graph, std::size_t index) {
  const Node& node = graph.nodes[index];
  if (elementOf(node) == "Background" || elementOf(node) == "TextureBackground") {
    std::array color{0.0, 0.0, 0.0};
    readNumbers(node, "skyColor", color);
    return Vec3f{static_cast<float>(color[0]), static_cast<float>(color[1]), static_cast<float>(color[2])};
  }
  for (const std::size_t child : node.children)
    if (const std::optional<Vec3f> color = firstSkyColor(graph, child))
      return color;
  return std::nullopt;
}

} // namespace

std::optional<Vec3f> skyColorOf(const SceneGraph& graph) {
  if (graph.background)
    return graph.background->skyColor;
  for (const std::size_t root : graph.roots)
    if (const std::optional<Vec3f> color = firstSkyColor(graph, root))
      return color;
  return std::nullopt;
}

} // namespace imgeo
