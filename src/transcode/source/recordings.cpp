#include "transcode/source/recordings.h"

#include "base/error.h"
#include "scene/deformation.h"
#include "scene/pose.h"
#include "sequence/sequence_index.h"
#include "transcode/source/moving_vertices.h"
#include "transcode/source/sequence_frames.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace imgeo {

namespace {

/// Whether a node is an interpolator from which a route leads.
bool isRouted(const SceneGraph& graph, std::size_t node) {
  return std::ranges::any_of(graph.routes, [&](const Route& route) { return route.fromNode == node; });
}

/// The parents of all nodes.
std::vector<std::vector<std::size_t>> parentsOf(const SceneGraph& graph) {
  std::vector<std::vector<std::size_t>> parents(graph.nodes.size());
  for (const std::size_t node : nodesInOrder(graph))
    for (const std::size_t child : graph.nodes[node].children)
      parents[child].push_back(node);
  return parents;
}

/// The nodes that move the vertices of a shape: its displacers, its joints, and what is around these.
std::set<std::size_t> moversOf(const SceneGraph& graph, std::size_t shape) {
  std::set<std::size_t> movers;
  for (const std::size_t child : graph.nodes[shape].children)
    if (std::holds_alternative<Displacer>(graph.nodes[child].content))
      movers.insert(child);
  const std::map<std::size_t, std::size_t> humanoids = humanoidOfShapes(graph);
  const auto humanoid = humanoids.find(shape);
  if (humanoid == humanoids.end())
    return movers;
  const std::vector<std::vector<std::size_t>> parents = parentsOf(graph);
  std::vector<std::size_t> pending = std::get<Humanoid>(graph.nodes[humanoid->second].content).joints;
  while (!pending.empty()) {
    const std::size_t node = pending.back();
    pending.pop_back();
    if (movers.insert(node).second)
      pending.insert(pending.end(), parents[node].begin(), parents[node].end());
  }
  return movers;
}

/// The TimeSensors whose animations move a shape's vertices; enabled ones first.
std::vector<std::size_t> sensorsOf(const SceneGraph& graph, std::size_t shape) {
  const std::set<std::size_t> movers = moversOf(graph, shape);
  std::set<std::size_t> interpolators;
  for (const Route& route : graph.routes)
    if (movers.contains(route.toNode))
      interpolators.insert(route.fromNode);
  std::vector<std::size_t> sensors;
  for (const Route& route : graph.routes)
    if (interpolators.contains(route.toNode) &&
        std::holds_alternative<TimeSensor>(graph.nodes[route.fromNode].content) &&
        std::ranges::find(sensors, route.fromNode) == sensors.end())
      sensors.push_back(route.fromNode);
  std::ranges::stable_partition(
      sensors, [&](std::size_t sensor) { return std::get<TimeSensor>(graph.nodes[sensor].content).enabled; });
  return sensors;
}

/// A shape of a scene at moments that are equally far apart.
class DeformedFrames : public FrameSource {
public:
  DeformedFrames(std::shared_ptr<const Scene> scene, std::size_t shape, std::size_t sensor, std::size_t steps)
      : scene_(std::move(scene)), shape_(shape), sensor_(sensor), steps_(steps) {
    const Mesh first = meshAt(0), last = meshAt(1);
    const bool isClosed = first.positions == last.positions && first.normals == last.normals;
    count_ = steps_ + (isClosed ? 0 : 1);
  }

  std::size_t count() const override { return count_; }
  Mesh read(std::size_t frame) const override {
    return meshAt(static_cast<double>(frame) / static_cast<double>(steps_));
  }

private:
  Mesh meshAt(double fraction) const {
    return posedMesh(*scene_, shape_, poseAt(scene_->graph, sensor_, std::min(1.0, fraction)));
  }

  std::shared_ptr<const Scene> scene_;
  std::size_t shape_, sensor_, steps_;
  std::size_t count_ = 0;
};

/// Removes interpolators that have lost what they moved, with the routes to them.
void removeInterpolators(SceneGraph& graph, const std::set<std::size_t>& candidates) {
  std::set<std::size_t> removed;
  for (const std::size_t node : candidates)
    if (!isRouted(graph, node))
      removed.insert(node);
  const auto isRemoved = [&](std::size_t node) { return removed.contains(node); };
  std::erase_if(graph.routes, [&](const Route& route) { return isRemoved(route.toNode); });
  std::erase_if(graph.roots, isRemoved);
  for (Node& node : graph.nodes)
    std::erase_if(node.children, isRemoved);
}

/// Removes the meshes that no shape uses.
void removeUnusedMeshes(Scene& scene) {
  std::vector<Mesh> meshes;
  std::map<std::size_t, std::size_t> newOf;
  for (const std::size_t node : shapeNodes(scene.graph)) {
    Shape& shape = std::get<Shape>(scene.graph.nodes[node].content);
    const auto [found, isNew] = newOf.try_emplace(shape.mesh, meshes.size());
    if (isNew)
      meshes.push_back(std::move(scene.meshes[shape.mesh]));
    shape.mesh = found->second;
  }
  scene.meshes = std::move(meshes);
}

/// Adds the interpolator that will have the frames of a shape's vertices.
std::size_t addFrames(SceneGraph& graph, std::size_t shape, std::size_t sensor) {
  const std::string& name = graph.nodes[shape].name;
  const std::size_t frames = addNode(graph, {(name.empty() ? "sequence" : name) + "-frames",
                                             Interpolator{InterpolatorKind::coordinate, {}, {}, "frames"},
                                             {},
                                             ""});
  graph.nodes[shape].children.push_back(frames);
  graph.routes.push_back({sensor, "fraction_changed", frames, "set_fraction"});
  return frames;
}

Recording recordShape(SceneGraph& graph, const std::shared_ptr<const Scene>& original, std::size_t shape,
                      std::size_t sensor, double rate) {
  const double seconds = std::get<TimeSensor>(graph.nodes[sensor].content).cycleInterval;
  const std::size_t steps = requireSteps(std::max(1.0, std::round(seconds * rate)), seconds);
  auto frames = std::make_shared<DeformedFrames>(original, shape, sensor, steps);
  const double ofFrames = rateOf(*frames, seconds);
  return {
      .shape = shape, .interpolator = addFrames(graph, shape, sensor), .frames = std::move(frames), .rate = ofFrames};
}

/// The recordings of joints and displacers. There may be none.
std::vector<Recording> recordDeformations(Scene& scene, double rate, std::vector<std::string>& warnings) {
  SceneGraph& graph = scene.graph;
  std::map<std::size_t, std::size_t> sensors; ///< by shape
  std::set<std::size_t> interpolators;        ///< of displacers
  for (const std::size_t node : shapeNodes(graph)) {
    if (!isDeformed(scene.meshes[shapeOf(graph, node).mesh]))
      continue;
    const std::vector<std::size_t> found = sensorsOf(graph, node);
    if (!found.empty())
      sensors[node] = found.front();
    if (found.size() > 1)
      warnings.push_back(fmt::format("The sequence of \"{}\" is its animation \"{}\"; {} others are left out.",
                                     graph.nodes[node].name, graph.nodes[found.front()].name, found.size() - 1));
  }
  if (sensors.empty())
    return {};
  for (const Route& route : graph.routes)
    if (std::holds_alternative<Displacer>(graph.nodes[route.toNode].content))
      interpolators.insert(route.fromNode);

  const auto original = std::make_shared<const Scene>(scene);
  removeDeformations(scene);
  removeInterpolators(graph, interpolators);
  std::vector<Recording> recordings;
  for (const auto& [shape, sensor] : sensors) {
    recordings.push_back(recordShape(graph, original, shape, sensor, rate));
    scene.meshes.push_back(recordings.back().frames->read(0));
    std::get<Shape>(graph.nodes[shape].content).mesh = scene.meshes.size() - 1;
  }
  removeUnusedMeshes(scene);
  return recordings;
}

} // namespace

double rateOf(const FrameSource& frames, double seconds) {
  constexpr double maxRate = 1000; // of an index
  return std::min(maxRate, static_cast<double>(frames.count()) / seconds);
}

std::size_t requireSteps(double steps, double seconds) {
  if (steps >= maxSequenceFrames)
    throw Error(ErrorKind::limit, "",
                fmt::format("{} s of animation have more than {} frames", seconds, maxSequenceFrames));
  return static_cast<std::size_t>(steps);
}

std::vector<Recording> recordScene(Scene& scene, double rate, bool deformations, const std::string& location,
                                   std::vector<std::string>& warnings) {
  std::vector<Recording> recordings = recordedSequences(scene);
  std::ranges::move(recordInterpolators(scene, rate), std::back_inserter(recordings));
  if (deformations)
    std::ranges::move(recordDeformations(scene, rate, warnings), std::back_inserter(recordings));
  for (const Recording& recording : recordings) // creases would divide the vertices of their frames
    scene.meshes[shapeOf(scene.graph, recording.shape).mesh].creaseDegrees = smoothDegrees;
  if (deformations && recordings.empty())
    throw Error(ErrorKind::unsupported, location, "has no animation that moves the vertices of a shape");
  const std::vector<std::size_t> order = shapeNodes(scene.graph);
  std::ranges::sort(recordings, {},
                    [&](const Recording& recording) { return std::ranges::find(order, recording.shape); });
  return recordings;
}

Recording recordingOfFiles(SceneGraph& graph, std::shared_ptr<const FrameSource> frames, double rate) {
  const std::size_t shape = shapeNodes(graph).front();
  const std::string name = graph.nodes[shape].name.empty() ? "sequence" : graph.nodes[shape].name;
  TimeSensor clock;
  clock.cycleInterval = static_cast<double>(frames->count()) / rate;
  clock.loop = true;
  const std::size_t sensor = addRoot(graph, {name + "-clock", clock, {}, ""});
  return {.shape = shape, .interpolator = addFrames(graph, shape, sensor), .frames = std::move(frames), .rate = rate};
}

} // namespace imgeo
