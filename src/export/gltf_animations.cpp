#include "export/gltf_animations.h"

#include "export/export.h"
#include "export/gltf_deformation.h"
#include "scene/gltf_channels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace imgeo {

namespace {

const char* nameOf(GltfPath path) {
  switch (path) {
  case GltfPath::translation:
    return "translation";
  case GltfPath::rotation:
    return "rotation";
  case GltfPath::scale:
    return "scale";
  case GltfPath::weights:
    break;
  }
  return "weights";
}

/// The animation of the weights of a shape's displacers: nullptr for those that it does not change.
struct WeightChannel {
  std::size_t sensor, shape;
  std::vector<const Interpolator*> interpolators; ///< by displacer
};

std::vector<WeightChannel> weightChannelsOf(const Scene& scene, const std::vector<GltfChannel>& all,
                                            std::size_t shape) {
  const std::vector<std::size_t> displacers = displacersOf(scene, shape);
  if (displacers.empty())
    return {};
  std::map<std::size_t, WeightChannel> channels; ///< by sensor
  for (const auto& [clock, value, path] : all) {
    const auto displacer = std::ranges::find(displacers, value->toNode);
    if (path != GltfPath::weights || displacer == displacers.end())
      continue;
    WeightChannel& channel =
        channels.try_emplace(clock->fromNode, WeightChannel{clock->fromNode, shape, {}}).first->second;
    channel.interpolators.resize(displacers.size());
    channel.interpolators[static_cast<std::size_t>(displacer - displacers.begin())] =
        &std::get<Interpolator>(scene.graph.nodes[clock->toNode].content);
  }
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

/// The same with a key at the end of the cycle, where the last value still holds.
Interpolator heldUntilEnd(Interpolator interpolator) {
  const auto last = interpolator.values.end() - static_cast<std::ptrdiff_t>(componentsOf(interpolator.kind));
  const std::vector<float> value(last, interpolator.values.end());
  interpolator.values.insert(interpolator.values.end(), value.begin(), value.end());
  interpolator.keys.push_back(1);
  return interpolator;
}

class AnimationWriter {
public:
  AnimationWriter(const SceneGraph& graph, GltfArrays& arrays) : graph_(graph), arrays_(arrays) {}

  /// Adds a sampler for a channel and returns its index in the animation. The first sampler lasts for the whole cycle,
  /// since viewers repeat an animation after its last key.
  std::size_t addSampler(const GltfChannel& channel, double seconds, Json& samplers) {
    auto interpolator = std::get<Interpolator>(graph_.nodes[channel.clock->toNode].content);
    if (samplers.empty() && interpolator.keys.back() < 1)
      interpolator = heldUntilEnd(std::move(interpolator));
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
    if (samplers.empty())
      keys.try_emplace(1, false);
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

  std::size_t addValues(const GltfChannel& channel, const Interpolator& interpolator) {
    const std::vector<float>& values = interpolator.values;
    // A node with a center is written as two, of which the first has the translation to the center.
    const Vec3d center = channel.path == GltfPath::translation
                             ? std::get<Transform>(graph_.nodes[channel.value->toNode].content).center
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
  for (const GltfChannel& channel : gltfChannelsOf(graph))
    if (channel.path != GltfPath::weights)
      nodes.insert(channel.value->toNode);
  return nodes;
}

std::size_t routesInGltf(const SceneGraph& graph) {
  std::set<const Route*> routes;
  for (const GltfChannel& channel : gltfChannelsOf(graph))
    routes.insert({channel.clock, channel.value});
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
  const std::vector<GltfChannel> channels = gltfChannelsOf(graph);
  for (const GltfChannel& channel : channels) {
    const auto nodes = gltfNodes.transforms.find(channel.value->toNode);
    if (channel.path == GltfPath::weights || nodes == gltfNodes.transforms.end())
      continue;
    const std::size_t sensor = channel.clock->fromNode;
    Json& animation = animationOf(sensor);
    addChannels(animation, writer.addSampler(channel, secondsOf(sensor), animation["samplers"]), nodes->second,
                nameOf(channel.path));
  }
  for (const auto& [shape, nodes] : gltfNodes.shapes) {
    std::vector<double> rest;
    for (const std::size_t displacer : displacersOf(scene, shape))
      rest.push_back(std::get<Displacer>(graph.nodes[displacer].content).weight);
    for (const WeightChannel& channel : weightChannelsOf(scene, channels, shape)) {
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
