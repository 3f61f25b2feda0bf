#include "scene/gltf_channels.h"

#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace imgeo {

namespace {

/// The path that sets a field of a Transform.
std::optional<GltfPath> pathOf(std::string_view field) {
  static constexpr std::array<std::pair<std::string_view, GltfPath>, 3> paths{
      {{"translation", GltfPath::translation}, {"rotation", GltfPath::rotation}, {"scale", GltfPath::scale}}};
  if (field.starts_with("set_"))
    field.remove_prefix(4);
  for (const auto& [name, path] : paths)
    if (field == name)
      return path;
  return {};
}

/// The path of a route from an interpolator; nothing where glTF has none.
std::optional<GltfPath> pathOf(const SceneGraph& graph, const Interpolator& interpolator, const Route& route) {
  if (interpolator.keys.empty() || interpolator.keys.front() < 0 || !faultOf(interpolator).empty())
    return {};
  const NodeContent& target = graph.nodes[route.toNode].content;
  if (std::holds_alternative<Displacer>(target)) {
    const bool setsWeight = route.toField.ends_with("weight") && interpolator.kind == InterpolatorKind::scalar;
    return setsWeight ? std::optional(GltfPath::weights) : std::nullopt;
  }
  const Transform* transform = std::get_if<Transform>(&target);
  const std::optional<GltfPath> path = pathOf(route.toField);
  if (!transform || !path || transform->scaleOrientation.angle != 0)
    return {};
  const InterpolatorKind kind =
      *path == GltfPath::rotation ? InterpolatorKind::orientation : InterpolatorKind::position;
  return interpolator.kind == kind ? path : std::nullopt;
}

} // namespace

std::vector<GltfChannel> gltfChannelsOf(const SceneGraph& graph) {
  std::map<std::size_t, std::vector<const Route*>> routesFrom; ///< by interpolator
  for (const Route& route : graph.routes)
    if (std::holds_alternative<Interpolator>(graph.nodes[route.fromNode].content))
      routesFrom[route.fromNode].push_back(&route);
  std::vector<GltfChannel> channels;
  for (const Route& clock : graph.routes) {
    if (!std::holds_alternative<TimeSensor>(graph.nodes[clock.fromNode].content) ||
        clock.fromField != "fraction_changed" || clock.toField != "set_fraction")
      continue;
    const auto routes = routesFrom.find(clock.toNode);
    if (routes == routesFrom.end())
      continue;
    const Interpolator& interpolator = std::get<Interpolator>(graph.nodes[clock.toNode].content);
    for (const Route* route : routes->second)
      if (const std::optional<GltfPath> path = pathOf(graph, interpolator, *route))
        channels.push_back({&clock, route, *path});
  }
  return channels;
}

} // namespace imgeo
