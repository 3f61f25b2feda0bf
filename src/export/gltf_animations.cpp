#include "export/gltf_animations.h"

#include "export/export.h"
#include "export/gltf_deformation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

namespace imgeo {

namespace {

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

/// Calls visit(clock, interpolator, route) for each route from an interpolator that a TimeSensor drives, by the route
/// `clock`.
template <typename Visit> void visitDriven(const SceneGraph& graph, Visit visit) {
  for (const Route& clock : graph.routes) {
    if (!std::holds_alternative<TimeSensor>(graph.nodes[clock.fromNode].content) ||
        clock.fromField != "fraction_changed" || clock.toField != "set_fraction")
      continue;
    if (const auto* interpolator = std::get_if<Interpolator>(&graph.nodes[clock.toNode].content))
      for (const Route& route : graph.routes)
        if (route.fromNode == clock.toNode)
          visit(clock, *interpolator, route);
  }
}

/// The path of glTF that a route from an interpolator sets; nullptr where it sets none.
const char* pathOf(const SceneGraph& graph, const Interpolator& interpolator, const Route& route) {
  const auto* transform = std::get_if<Transform>(&graph.nodes[route.toNode].content);
  const char* path = pathOf(route.toField);
  const bool isSet = transform && path && transform->scaleOrientation.angle == 0 && canBeWritten(interpolator, path);
  return isSet ? path : nullptr;
}

/// Whether a route from an interpolator to a displacer sets its weight.
bool setsWeight(const Interpolator& interpolator, const Route& route) {
  return route.toField.ends_with("weight") && interpolator.kind == InterpolatorKind::scalar &&
         !interpolator.keys.empty() && interpolator.keys.front() >= 0 && faultOf(interpolator).empty();
}

std::vector<Channel> channelsOf(const SceneGraph& graph) {
  std::vector<Channel> channels;
  visitDriven(graph, [&](const Route& clock, const Interpolator& interpolator, const Route& route) {
    if (const char* path = pathOf(graph, interpolator, route))
      channels.push_back({clock.fromNode, route.fromNode, route.toNode, path});
  });
  return channels;
}

/// The animation of the weights of a shape's displacers: nullptr for those that it does not change.
struct WeightChannel {
  std::size_t sensor, shape;
  std::vector<const Interpolator*> interpolators; ///< by displacer
};

std::vector<WeightChannel> weightChannelsOf(const Scene& scene, std::size_t shape) {
  const std::vector<std::size_t> displacers = displacersOf(scene, shape);
  if (displacers.empty())
    return {};
  std::map<std::size_t, WeightChannel> channels; ///< by sensor
  visitDriven(scene.graph, [&](const Route& clock, const Interpolator& interpolator, const Route& route) {
    const auto displacer = std::ranges::find(displacers, route.toNode);
    if (displacer == displacers.end() || !setsWeight(interpolator, route))
      return;
    WeightChannel& channel =
        channels.try_emplace(clock.fromNode, WeightChannel{clock.fromNode, shape, {}}).first->second;
    channel.interpolators.resize(displacers.size());
    channel.interpolators[static_cast<std::size_t>(displacer - displacers.begin())] = &interpolator;
  });
  std::vector<WeightChannel> list;
  for (auto& [sensor, channel] : channels)
    list.push_back(std::move(channel));
  return list;
}

/// The value of a ScalarInterpolator at a key of any of several; at a step before (`isAfter` false) or after it.
float scalarAt(const Interpolator& interpolator, float key, bool isAfter) {
  const std::vector<float>& keys = interpolator.keys;
  const auto found = isAfter ? std::ranges::upper_bound(keys, key) : std::ranges::lower_bound(keys, key);
  const auto next = static_cast<std::size_t>(found - keys.begin());
  if (next == keys.size())
    return interpolator.values.back();
  if (keys[next] == key || next == 0)
    return interpolator.values[next];
  const float t = (key - keys[next - 1]) / (keys[next] - keys[next - 1]);
  return std::lerp(interpolator.values[next - 1], interpolator.values[next], t);
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

  /// Adds a sampler for the weights of a shape: with all keys of its displacers, steps twice.
  std::size_t addWeightSampler(const WeightChannel& channel, const std::vector<double>& rest, double seconds,
                               Json& samplers) {
    std::map<float, bool> keys; ///< whether some interpolator steps there
    for (const Interpolator* interpolator : channel.interpolators)
      for (std::size_t i = 0; interpolator && i < interpolator->keys.size(); ++i)
        keys[interpolator->keys[i]] |= i > 0 && interpolator->keys[i] == interpolator->keys[i - 1];
    std::vector<float> times, values;
    const auto add = [&](float key, bool isAfter) {
      times.push_back(key);
      for (std::size_t i = 0; i < rest.size(); ++i)
        values.push_back(channel.interpolators[i] ? scalarAt(*channel.interpolators[i], key, isAfter)
                                                  : static_cast<float>(rest[i]));
    };
    for (const auto& [key, isStep] : keys) {
      add(key, false);
      if (isStep)
        add(key, true);
    }
    const std::size_t input = addKeys(times, seconds);
    arrays_.begin();
    for (const float value : values)
      appendLittle(arrays_.bytes, value);
    const std::size_t output = arrays_.end(0, floatType, "SCALAR", values.size());
    arrays_.views.back().erase("target");
    samplers.push_back({{"input", input}, {"output", output}, {"interpolation", "LINEAR"}});
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
    const std::size_t accessor = arrays_.end(0, floatType, "SCALAR", times.size());
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
    const std::size_t accessor = arrays_.end(0, floatType, isRotation ? "VEC4" : "VEC3", values.size() / components);
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

std::size_t routesInGltf(const SceneGraph& graph) {
  std::set<const Route*> routes;
  visitDriven(graph, [&](const Route& clock, const Interpolator& interpolator, const Route& route) {
    const bool isDisplacer = std::holds_alternative<Displacer>(graph.nodes[route.toNode].content);
    if (pathOf(graph, interpolator, route) || (isDisplacer && setsWeight(interpolator, route)))
      routes.insert({&clock, &route});
  });
  return routes.size();
}

Json gltfAnimations(const Scene& scene, const GltfNodes& gltfNodes, GltfArrays& arrays) {
  const SceneGraph& graph = scene.graph;
  AnimationWriter writer(graph, arrays);
  std::vector<std::pair<std::size_t, Json>> animations; ///< by TimeSensor
  const auto animationOf = [&](std::size_t sensor) -> Json& {
    const auto found = std::ranges::find(animations, sensor, [](const auto& each) { return each.first; });
    if (found != animations.end())
      return found->second;
    Json animation{{"samplers", Json::array()}, {"channels", Json::array()}};
    if (const std::string& name = graph.nodes[sensor].name; !name.empty())
      animation["name"] = name;
    return animations.emplace_back(sensor, std::move(animation)).second;
  };
  const auto secondsOf = [&](std::size_t sensor) {
    return std::get<TimeSensor>(graph.nodes[sensor].content).cycleInterval;
  };
  const auto addChannels = [](Json& animation, std::size_t sampler, const std::vector<std::size_t>& nodes,
                              const char* path) {
    for (const std::size_t node : nodes)
      animation["channels"].push_back({{"sampler", sampler}, {"target", {{"node", node}, {"path", path}}}});
  };
  for (const Channel& channel : channelsOf(graph)) {
    const auto nodes = gltfNodes.transforms.find(channel.node);
    if (nodes == gltfNodes.transforms.end())
      continue;
    Json& animation = animationOf(channel.sensor);
    addChannels(animation, writer.addSampler(channel, secondsOf(channel.sensor), animation["samplers"]), nodes->second,
                channel.path);
  }
  for (const auto& [shape, nodes] : gltfNodes.shapes) {
    std::vector<double> rest;
    for (const std::size_t displacer : displacersOf(scene, shape))
      rest.push_back(std::get<Displacer>(graph.nodes[displacer].content).weight);
    for (const WeightChannel& channel : weightChannelsOf(scene, shape)) {
      Json& animation = animationOf(channel.sensor);
      addChannels(animation, writer.addWeightSampler(channel, rest, secondsOf(channel.sensor), animation["samplers"]),
                  nodes, "weights");
    }
  }
  Json list = Json::array();
  for (auto& [sensor, animation] : animations)
    list.push_back(std::move(animation));
  return list;
}

} // namespace imgeo
