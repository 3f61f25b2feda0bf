#include "transcode/verify/compare_gltf_animations.h"

#include "scene/gltf_channels.h"
#include "transcode/verify/gltf_curve.h"
#include "transcode/verify/gltf_targets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace imgeo {

namespace {

struct MovedField {
  GltfCurve curve;
  Affine3d worldFromParent;
};

/// What a TimeSensor animates: fields of targets.
struct SensorAnimation {
  const TimeSensor* sensor = nullptr;
  std::map<std::pair<GltfTarget, GltfPath>, MovedField> fields;
};

/// The animations of a scene in the order of their first channels, and what of the scene they use.
struct GltfAnimations {
  std::vector<SensorAnimation> sensors;
  std::set<const Route*> routes;
  std::set<std::size_t> interpolators;
};

/// Adds constant curves for weights of shapes of which an animation sets others: glTF sets all weights of a mesh.
void addConstantWeights(const SceneGraph& graph, const GltfTargets& targets, SensorAnimation& animation) {
  std::set<std::size_t> shapes;
  for (const auto& [key, field] : animation.fields)
    if (key.second == GltfPath::weights)
      shapes.insert(key.first.firstShape);
  for (const std::size_t shape : shapes)
    for (std::size_t number = 0; const std::size_t displacer : targets.displacers.at(shape))
      animation.fields.try_emplace(
          {{shape, shape + 1, number++}, GltfPath::weights},
          MovedField{GltfCurve{.constant = std::get<Displacer>(graph.nodes[displacer].content).weight}, {}});
}

GltfAnimations animationsOf(const SceneGraph& graph) {
  const std::vector<GltfChannel> channels = gltfChannelsOf(graph);
  const GltfTargets targets = gltfTargetsOf(graph, channels);
  GltfAnimations animations;
  std::map<std::size_t, std::size_t> indices; ///< into `sensors`, by node
  for (const auto& [clock, value, path] : channels) {
    const auto found = targets.ofNode.find(value->toNode);
    if (found == targets.ofNode.end())
      continue;
    const TimeSensor& sensor = std::get<TimeSensor>(graph.nodes[clock->fromNode].content);
    const auto [index, isNew] = indices.try_emplace(clock->fromNode, animations.sensors.size());
    if (isNew)
      animations.sensors.push_back({&sensor, {}});
    const Transform* transform = std::get_if<Transform>(&graph.nodes[value->toNode].content);
    GltfCurve curve{.interpolator = &std::get<Interpolator>(graph.nodes[clock->toNode].content),
                    .seconds = sensor.cycleInterval};
    if (transform && path == GltfPath::translation)
      curve.offset = transform->center;
    for (const auto& [target, worldFromParent] : found->second)
      animations.sensors[index->second].fields[{target, path}] = {curve, worldFromParent};
    animations.routes.insert({clock, value});
    animations.interpolators.insert(clock->toNode);
  }
  for (SensorAnimation& animation : animations.sensors)
    addConstantWeights(graph, targets, animation);
  return animations;
}

/// Equal but for the rounding of the numbers of Transforms.
bool haveSameMaps(const Affine3d& a, const Affine3d& b) {
  const auto areNearVectors = [](Vec3d x, Vec3d y) { return length(x - y) <= 1e-5 * std::max(1.0, length(y)); };
  return areNearVectors(a.x, b.x) && areNearVectors(a.y, b.y) && areNearVectors(a.z, b.z) &&
         areNearVectors(a.translation, b.translation);
}

bool areEqual(const SensorAnimation& a, const SensorAnimation& b) {
  return std::ranges::equal(a.fields, b.fields, [](const auto& left, const auto& right) {
    return left.first == right.first && haveSameMaps(left.second.worldFromParent, right.second.worldFromParent) &&
           areEqualCurves(left.second.curve, right.second.curve);
  });
}

/// Whether TimeSensors play alike.
bool playAlike(const TimeSensor& a, const TimeSensor& b) {
  return a.enabled == b.enabled && a.loop == b.loop && a.startTime == b.startTime && a.stopTime == b.stopTime &&
         a.pauseTime == b.pauseTime && a.resumeTime == b.resumeTime &&
         std::abs(a.cycleInterval - b.cycleInterval) <= 1e-6 * std::max(1.0, a.cycleInterval);
}

} // namespace

BeyondGltf compareGltfAnimations(const SceneDocument& site, const SceneGraph& input, Findings& findings) {
  const GltfAnimations inSite = animationsOf(site.graph), inInput = animationsOf(input);
  std::vector<const SensorAnimation*> unmatched;
  for (const SensorAnimation& animation : inInput.sensors)
    unmatched.push_back(&animation);
  BeyondGltf beyond;
  std::size_t missing = 0;
  for (const SensorAnimation& animation : inSite.sensors) {
    const auto match =
        std::ranges::find_if(unmatched, [&](const SensorAnimation* other) { return areEqual(animation, *other); });
    if (match == unmatched.end()) {
      ++missing;
      continue;
    }
    beyond.clocks += !playAlike(*animation.sensor, *(*match)->sensor);
    unmatched.erase(match);
  }
  if (missing > 0)
    findings.add("{} of {} animations of the site are not in the input.", missing, inSite.sensors.size());
  if (!unmatched.empty())
    findings.add("{} of {} animations of the input are not in the site.", unmatched.size(), inInput.sensors.size());
  const auto routes = site.otherElements.find("ROUTE");
  beyond.routes = (routes == site.otherElements.end() ? 0 : routes->second) - inSite.routes.size();
  beyond.interpolators = countNodes<Interpolator>(site.graph) - inSite.interpolators.size();
  beyond.timeSensors = countNodes<TimeSensor>(site.graph) - inSite.sensors.size();
  return beyond;
}

} // namespace imgeo
