#include "scene/source_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <span>
#include <string_view>

namespace imgeo {

namespace {

/// The rotation that turns a direction to +y, without rounding errors. For z up, -y becomes +z, X3D's front, as in
/// modelling programs.
Affine3d uprightFrom(AxisDirection up) {
  switch (up) {
  case AxisDirection::x:
    return {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}, {}};
  case AxisDirection::minusX:
    return {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}, {}};
  case AxisDirection::minusY:
    return {{1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {}};
  case AxisDirection::z:
    return {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {}};
  case AxisDirection::minusZ:
    return {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {}};
  case AxisDirection::y:
    break;
  }
  return {};
}

Affine3d rotationOf(const AxisRotation& rotation) {
  Vec3d axis;
  axis[rotation.axis] = 1;
  Affine3d map = affineOf(Rotation{axis, rotation.degrees * std::numbers::pi / 180});
  if (std::fmod(rotation.degrees, 90) == 0) // quarter turns are exact
    for (Vec3d* column : {&map.x, &map.y, &map.z})
      *column = {std::round(column->x), std::round(column->y), std::round(column->z)};
  return map;
}

/// Elements of an X3D document that must precede the nodes which use them.
constexpr std::array<std::string_view, 4> declarations{"ProtoDeclare", "ExternProtoDeclare", "component", "unit"};
/// Elements that may only stand at the top, and refer to the nodes before them.
constexpr std::array<std::string_view, 6> statements{"ROUTE", "IMPORT", "EXPORT", "LayerSet", "Layer", "LayoutLayer"};

bool isElement(const Node& node, std::span<const std::string_view> names) {
  const GenericNode* const generic = std::get_if<GenericNode>(&node.content);
  return generic && std::ranges::find(names, generic->element) != names.end();
}

void wrap(SceneGraph& graph, const Affine3d& map) {
  std::vector<std::size_t> before, wrapped, after;
  for (const std::size_t root : graph.roots) {
    const Node& node = graph.nodes[root];
    (isElement(node, declarations) ? before : isElement(node, statements) ? after : wrapped).push_back(root);
  }
  before.push_back(addNode(graph, {"", transformOf(map), std::move(wrapped), ""}));
  before.insert(before.end(), after.begin(), after.end());
  graph.roots = std::move(before);
}

/// Adds the factor of heights to the Transform of wrap() as metadata.
void stateExaggeration(SceneGraph& graph, double exaggeration) {
  Node metadata{"", GenericNode{"MetadataDouble", "", {}}, {}, ""};
  metadata.fields = {
      {"containerField", "metadata"}, {"name", "verticalExaggeration"}, {"value", fmt::format("{}", exaggeration)}};
  const std::size_t index = addNode(graph, std::move(metadata));
  for (const std::size_t root : graph.roots)
    if (Node& node = graph.nodes[root]; std::holds_alternative<Transform>(node.content))
      node.children.insert(node.children.begin(), index);
}

} // namespace

const char* nameOf(AxisDirection direction) {
  constexpr std::array names{"x", "y", "z", "-x", "-y", "-z"};
  return names[static_cast<std::size_t>(direction)];
}

Affine3d documentFromSource(const SourceAxes& axes) {
  Affine3d map = uprightFrom(axes.up);
  for (const AxisRotation& rotation : axes.rotations)
    map = rotationOf(rotation) * map;
  for (Vec3d* column : {&map.x, &map.y, &map.z}) {
    *column = *column * axes.scale;
    column->y *= axes.exaggeration;
  }
  return map;
}

void applySourceAxes(SceneGraph& graph, const SourceAxes& axes) {
  const Affine3d map = documentFromSource(axes);
  if (map == Affine3d{})
    return;
  wrap(graph, map);
  if (axes.exaggeration != 1)
    stateExaggeration(graph, axes.exaggeration);
}

void undoSourceAxes(SceneGraph& graph, const SourceAxes& axes) {
  const Affine3d map = documentFromSource(axes);
  if (map == Affine3d{})
    return;
  // The inverse of a rotation is its transpose.
  const double scale = 1 / (axes.scale * axes.scale), height = scale / (axes.exaggeration * axes.exaggeration);
  wrap(graph, {Vec3d{map.x.x, map.y.x, map.z.x} * scale,
               Vec3d{map.x.y, map.y.y, map.z.y} * height,
               Vec3d{map.x.z, map.y.z, map.z.z} * scale,
               {}});
}

} // namespace imgeo
