#include "export/gltf_animations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace imgeo {

namespace {

constexpr int keyComponentType = 5126; // floats

/// The path of glTF for the field of a Transform that a route names; nullptr for another field.
const char* pathOf(std::string_view field) {
  if (field.starts_with("set_"))
    field.remove_prefix(4);
  for (const char* path : {"translation", "rotation", "scale"})
    if (field == path)
      return path;
  return nullptr;
}

/// A TimeSensor, an interpolator and the Transform that it moves.
struct Channel {
  std::size_t sensor, interpolator, node;
  const char* path;
};

bool canBeWritten(const Interpolator& interpolator, const char* path) {
  const InterpolatorKind kind =
      path == std::string_view("rotation") ? InterpolatorKind::orientation : InterpolatorKind::position;
  return interpolator.kind == kind && !interpolator.keys.empty() && interpolator.keys.front() >= 0 &&
         faultOf(interpolator).empty();
}

std::vector<Channel> channelsOf(const SceneGraph& graph) {
  std::vector<Channel> channels;
  for (const Route& clock : graph.routes) {
    if (!std::holds_alternative<TimeSensor>(graph.nodes[clock.fromNode].content) ||
        clock.fromField != "fraction_changed" || clock.toField != "set_fraction")
      continue;
    const auto* interpolator = std::get_if<Interpolator>(&graph.nodes[clock.toNode].content);
    for (const Route& route : graph.routes) {
      const auto* transform = std::get_if<Transform>(&graph.nodes[route.toNode].content);
      const char* path = pathOf(route.toField);
      if (interpolator && transform && path && route.fromNode == clock.toNode &&
          transform->scaleOrientation.angle == 0 && canBeWritten(*interpolator, path))
        channels.push_back({clock.fromNode, clock.toNode, route.toNode, path});
    }
  }
  return channels;
}

class AnimationWriter {
public:
  AnimationWriter(const SceneGraph& graph, GltfArrays& arrays) : graph_(graph), arrays_(arrays) {}

  /// Adds a sampler for a channel and returns its index in the animation.
  std::size_t addSampler(const Channel& channel, double seconds, Json& samplers) {
    const auto& interpolator = std::get<Interpolator>(graph_.nodes[channel.interpolator].content);
    const std::size_t input = addKeys(interpolator.keys, seconds);
    samplers.push_back({{"input", input}, {"output", addValues(channel, interpolator)}, {"interpolation", "LINEAR"}});
    return samplers.size() - 1;
  }

private:
  /// Times must ascend strictly: of two equal keys, the second is moved by the smallest step.
  std::size_t addKeys(const std::vector<float>& keys, double cycleInterval) {
    std::vector<float> times;
    for (const float key : keys) {
      const auto time = static_cast<float>(key * cycleInterval);
      times.push_back(times.empty() || time > times.back()
                          ? time
                          : std::nextafter(times.back(), std::numeric_limits<float>::infinity()));
    }
    arrays_.begin();
    for (const float time : times)
      appendLittle(arrays_.bytes, time);
    const std::size_t accessor = arrays_.end(0, keyComponentType, "SCALAR", times.size());
    arrays_.views.back().erase("target"); // only vertex data has one
    arrays_.accessors.back()["min"] = {times.front()};
    arrays_.accessors.back()["max"] = {times.back()};
    return accessor;
  }

  std::size_t addValues(const Channel& channel, const Interpolator& interpolator) {
    const std::vector<float>& values = interpolator.values;
    // A node with a center is written as two, of which the first has the translation to the center.
    const Vec3d center = channel.path == std::string_view("translation")
                             ? std::get<Transform>(graph_.nodes[channel.node].content).center
                             : Vec3d{};
    const std::size_t components = componentsOf(interpolator.kind);
    arrays_.begin();
    for (std::size_t at = 0; at < values.size(); at += components) {
      if (interpolator.kind != InterpolatorKind::orientation) {
        for (int axis = 0; axis < 3; ++axis)
          appendLittle(arrays_.bytes, static_cast<float>(values[at + static_cast<std::size_t>(axis)] + center[axis]));
        continue;
      }
      for (const double number :
           quaternionOf({{values[at], values[at + 1], values[at + 2]}, static_cast<double>(values[at + 3])}))
        appendLittle(arrays_.bytes, static_cast<float>(number));
    }
    const bool isRotation = interpolator.kind == InterpolatorKind::orientation;
    const std::size_t accessor =
        arrays_.end(0, keyComponentType, isRotation ? "VEC4" : "VEC3", values.size() / components);
    arrays_.views.back().erase("target");
    return accessor;
  }

  const SceneGraph& graph_;
  GltfArrays& arrays_;
};

} // namespace

std::set<std::size_t> gltfAnimatedNodes(const SceneGraph& graph) {
  std::set<std::size_t> nodes;
  for (const Channel& channel : channelsOf(graph))
    nodes.insert(channel.node);
  return nodes;
}

Json gltfAnimations(const SceneGraph& graph, const std::map<std::size_t, std::vector<std::size_t>>& gltfNodes,
                    GltfArrays& arrays) {
  AnimationWriter writer(graph, arrays);
  std::vector<std::pair<std::size_t, Json>> animations; ///< by TimeSensor
  for (const Channel& channel : channelsOf(graph)) {
    const auto nodes = gltfNodes.find(channel.node);
    if (nodes == gltfNodes.end())
      continue;
    auto found = std::ranges::find(animations, channel.sensor, [](const auto& each) { return each.first; });
    if (found == animations.end()) {
      Json animation{{"samplers", Json::array()}, {"channels", Json::array()}};
      if (const std::string& name = graph.nodes[channel.sensor].name; !name.empty())
        animation["name"] = name;
      found = animations.insert(animations.end(), {channel.sensor, std::move(animation)});
    }
    Json& animation = found->second;
    const double seconds = std::get<TimeSensor>(graph.nodes[channel.sensor].content).cycleInterval;
    const std::size_t sampler = writer.addSampler(channel, seconds, animation["samplers"]);
    for (const std::size_t node : nodes->second)
      animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", channel.path}}}});
  }
  Json list = Json::array();
  for (auto& [sensor, animation] : animations)
    list.push_back(std::move(animation));
  return list;
}

} // namespace imgeo
