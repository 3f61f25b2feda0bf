#include "transcode/source/moving_vertices.h"

#include "import/mesh/unit_normal.h"
#include "import/x3d/faces.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace imgeo {

namespace {

/// The wedges around each face of a mesh, one face after the other.
struct Rings {
  std::vector<std::uint32_t> wedges;
  std::vector<std::size_t> ends;
};

/// Adds the ring around triangles that are one face: the edges of one triangle only.
void addRing(Rings& rings, std::span<const std::uint32_t> corners) {
  std::map<std::uint32_t, std::uint32_t> next;
  for (std::size_t corner = 0; corner < corners.size(); ++corner) {
    const std::uint32_t from = corners[corner], to = corners[corner % 3 == 2 ? corner - 2 : corner + 1];
    if (const auto back = next.find(to); back != next.end() && back->second == from)
      next.erase(back);
    else
      next[from] = to;
  }
  for (auto edge = next.find(corners[0]); edge != next.end();) {
    const auto [from, to] = *edge;
    rings.wedges.push_back(from);
    next.erase(edge);
    edge = next.find(to);
  }
  rings.ends.push_back(rings.wedges.size());
}

/// Triangles of one face follow one another and share wedges; those of two faces share none.
Rings ringsOf(const Mesh& mesh) {
  Rings rings;
  for (std::size_t begin = 0, end = 0; begin < mesh.corners.size(); begin = end) {
    std::set<std::uint32_t> wedges;
    const auto sharesWedge = [&](std::size_t triangle) {
      return wedges.empty() || wedges.contains(mesh.corners[triangle]) || wedges.contains(mesh.corners[triangle + 1]) ||
             wedges.contains(mesh.corners[triangle + 2]);
    };
    for (end = begin; end < mesh.corners.size() && sharesWedge(end); end += 3)
      wedges.insert(mesh.corners.begin() + static_cast<std::ptrdiff_t>(end),
                    mesh.corners.begin() + static_cast<std::ptrdiff_t>(end + 3));
    addRing(rings, std::span(mesh.corners).subspan(begin, end - begin));
  }
  return rings;
}

/// A mesh whose positions, and normals, are lists of values at the keys of interpolators.
class InterpolatedFrames : public FrameSource {
public:
  /// `normals`: without keys where they do not move by themselves.
  InterpolatedFrames(Mesh mesh, Interpolator coordinates, Interpolator normals, std::size_t steps)
      : mesh_(std::move(mesh)), coordinates_(std::move(coordinates)), normals_(std::move(normals)), steps_(steps) {
    if (coordinates_.creaseAngle)
      rings_ = ringsOf(mesh_);
    const bool isClosed = valuesOf(coordinates_, 0) == valuesOf(coordinates_, steps_) &&
                          (normals_.keys.empty() || valuesOf(normals_, 0) == valuesOf(normals_, steps_));
    count_ = steps_ + (isClosed ? 0 : 1);
  }

  std::size_t count() const override { return count_; }

  Mesh read(std::size_t frame) const override {
    Mesh mesh = mesh_;
    const std::vector<float> points = valuesOf(coordinates_, frame);
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge)
      mesh.positions[mesh.wedgePositions[wedge]] = vectorAt(points, coordinates_.points[wedge]);
    if (!normals_.keys.empty())
      setNormals(mesh, valuesOf(normals_, frame));
    else if (coordinates_.creaseAngle)
      setCreaseNormals(mesh, *coordinates_.creaseAngle);
    return mesh;
  }

private:
  static Vec3f vectorAt(const std::vector<float>& numbers, std::size_t index) {
    return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
  }

  /// The values at a step. Where keys are equally far apart, rounding of their decimals does not count.
  std::vector<float> valuesOf(const Interpolator& interpolator, std::size_t step) const {
    const std::size_t intervals = interpolator.keys.size() - 1;
    double fraction = static_cast<double>(step) / static_cast<double>(steps_);
    if (areEven(interpolator.keys)) {
      const std::size_t key = step * intervals / steps_;
      const double t = fraction * static_cast<double>(intervals) - static_cast<double>(key);
      const double first = interpolator.keys[key], next = interpolator.keys[std::min(key + 1, intervals)];
      fraction = step * intervals % steps_ == 0 ? first : first + t * (next - first);
    }
    const std::vector<double> values = valueAt(interpolator, fraction);
    return {values.begin(), values.end()};
  }

  void setNormals(Mesh& mesh, const std::vector<float>& numbers) const {
    for (std::size_t wedge = 0; wedge < mesh.wedgeCount(); ++wedge) {
      mesh.normals[wedge] = vectorAt(numbers, normals_.points[wedge]);
      makeUnit(mesh.normals[wedge]);
    }
  }

  void setCreaseNormals(Mesh& mesh, double creaseAngle) const {
    x3d::VertexData data;
    data.positions = mesh.positions;
    x3d::Faces faces;
    faces.ends = rings_.ends;
    for (const std::uint32_t wedge : rings_.wedges)
      faces.corners.push_back({mesh.wedgePositions[wedge], x3d::none, x3d::none, x3d::none});
    x3d::addCreaseNormals(data, faces, creaseAngle);
    for (std::size_t i = 0; i < rings_.wedges.size(); ++i)
      mesh.normals[rings_.wedges[i]] = data.normals[faces.corners[i].normal];
  }

  Mesh mesh_;
  Rings rings_; ///< where normals follow the faces
  Interpolator coordinates_, normals_;
  std::size_t steps_, count_ = 0;
};

/// The cycle of the TimeSensor that drives an interpolator; without one so long that a frame is a key.
double secondsOf(const SceneGraph& graph, std::size_t interpolator, double rate) {
  for (const Route& route : graph.routes)
    if (route.toNode == interpolator && route.toField.ends_with("fraction"))
      if (const auto* sensor = std::get_if<TimeSensor>(&graph.nodes[route.fromNode].content))
        return sensor->cycleInterval;
  const std::size_t keys = std::get<Interpolator>(graph.nodes[interpolator].content).keys.size();
  return static_cast<double>(std::max<std::size_t>(keys, 2) - 1) / rate;
}

/// The child of a Shape that has the values of its vertices.
std::optional<std::size_t> childWithPoints(const SceneGraph& graph, std::size_t shape, InterpolatorKind kind) {
  for (const std::size_t child : graph.nodes[shape].children)
    if (const auto* interpolator = std::get_if<Interpolator>(&graph.nodes[child].content);
        interpolator && interpolator->kind == kind && !interpolator->points.empty())
      return child;
  return {};
}

void removeNodes(SceneGraph& graph, const std::set<std::size_t>& removed) {
  const auto isRemoved = [&](std::size_t node) { return removed.contains(node); };
  std::erase_if(graph.routes, [&](const Route& route) { return isRemoved(route.toNode); });
  for (Node& node : graph.nodes)
    std::erase_if(node.children, isRemoved);
}

} // namespace

std::vector<Recording> recordInterpolators(Scene& scene, double rate) {
  SceneGraph& graph = scene.graph;
  std::vector<Recording> recordings;
  std::set<std::size_t> replaced;
  for (const std::size_t shape : shapeNodes(graph)) {
    const auto node = childWithPoints(graph, shape, InterpolatorKind::coordinate),
               normalNode = childWithPoints(graph, shape, InterpolatorKind::normal);
    if (!node)
      continue;
    auto& interpolator = std::get<Interpolator>(graph.nodes[*node].content);
    const double seconds = secondsOf(graph, *node, rate);
    const std::size_t steps = requireSteps(recordedSteps(interpolator.keys, seconds, rate), seconds);
    Interpolator coordinates =
        std::exchange(interpolator, Interpolator{InterpolatorKind::coordinate, {}, {}, "frames"});
    Interpolator normals{InterpolatorKind::normal, {}, {}};
    if (normalNode) {
      normals = std::get<Interpolator>(graph.nodes[*normalNode].content);
      replaced.insert(*normalNode);
    }
    Mesh& mesh = scene.meshes[shapeOf(graph, shape).mesh];
    auto frames = std::make_shared<InterpolatedFrames>(mesh, std::move(coordinates), std::move(normals), steps);
    mesh = frames->read(0);
    const double ofFrames = rateOf(*frames, seconds);
    recordings.push_back({.shape = shape, .interpolator = *node, .frames = std::move(frames), .rate = ofFrames});
  }
  removeNodes(graph, replaced);
  return recordings;
}

} // namespace imgeo
