#include "transcode/default_scene/start_view.h"

#include "base/box_corners.h"
#include "base/parallel.h"
#include "scene/pose.h"
#include "scene/shape_instances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <ranges>

namespace imgeo {

namespace {

constexpr double degree = std::numbers::pi / 180;

struct Candidate {
  double azimuth, elevation; ///< degrees: from +z towards +x, and above the horizon
};

/// Three-quarter views from the front and from behind. Views along an axis are left out: they hide depth.
std::vector<Candidate> candidates() {
  std::vector<Candidate> list;
  for (const double side : {25.0, -25.0, 45.0, -45.0, 65.0, -65.0})
    for (const double back : {0.0, 180.0})
      for (const double elevation : {8.0, 20.0, 35.0, 50.0})
        list.push_back({side + back, elevation});
  return list;
}

Vec3d directionOf(Candidate candidate) {
  const double azimuth = candidate.azimuth * degree, elevation = candidate.elevation * degree;
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

struct Visibility {
  double surface = 0; ///< share of the samples that are visible
  double picture = 0; ///< share of the picture that they cover
};

constexpr int bufferEdge = 40; ///< pixels of a depth buffer; a pixel of a visible surface has several of the samples

/// Four numbers that are computed at a time.
using Floats [[gnu::vector_size(16)]] = float;
using Ints [[gnu::vector_size(16)]] = std::int32_t;
constexpr std::size_t lanes = 4;

/// Four samples, relative to the centre of all, in pixels of a depth buffer. Those whose backs are visible have no
/// normal.
struct BufferPoints {
  std::array<Floats, 3> offset{}, normal{};
};

Floats dotOf(const std::array<Floats, 3>& vectors, const Vec3f& by) {
  return vectors[0] * by.x + vectors[1] * by.y + vectors[2] * by.z;
}

/// The scene's diagonal is as long as a buffer's edge. The last points may be followed by some that face down, which no
/// view from above shows.
std::vector<BufferPoints> bufferPointsOf(const std::vector<SurfaceSample>& samples, const Box3d& box) {
  const Vec3d center = box.center();
  const double pixelsPerUnit = bufferEdge / length(box.size());
  std::vector<BufferPoints> points((samples.size() + lanes - 1) / lanes);
  const auto set = [&](std::size_t i, const Vec3f& offset, const Vec3f& normal) {
    for (int axis = 0; axis < 3; ++axis) {
      points[i / lanes].offset[axis][i % lanes] = offset[axis];
      points[i / lanes].normal[axis][i % lanes] = normal[axis];
    }
  };
  for (std::size_t i = 0; i < lanes * points.size(); ++i)
    if (i < samples.size())
      set(i, Vec3f((samples[i].point - center) * pixelsPerUnit), samples[i].isSolid ? samples[i].normal : Vec3f{});
    else
      set(i, {}, {0, -1, 0});
  return points;
}

/// Draws points into a depth buffer with a parallel projection. `towardsViewer` has unit length, points upwards and is
/// not vertical.
Visibility visibilityOf(const std::vector<BufferPoints>& points, Vec3d towardsViewer) {
  constexpr float none = std::numeric_limits<float>::lowest();
  // Within a pixel, depths on a surface that is seen at 60 degrees differ by two pixels.
  constexpr float tolerance = 2;
  struct Drawn {
    std::int32_t pixel;
    float depth; ///< larger is nearer
  };
  const Vec3d towardsRight =
      Vec3d{towardsViewer.z, 0, -towardsViewer.x} * (1 / std::hypot(towardsViewer.x, towardsViewer.z));
  const Vec3f back(towardsViewer), right(towardsRight), up(cross(towardsViewer, towardsRight));
  const auto pixelsAlong = [](Floats distance) {
    const Floats pixel = distance + bufferEdge / 2.0f, first{}, last = first + (bufferEdge - 1.0f);
    const Floats notBefore = pixel < first ? first : pixel;
    return __builtin_convertvector(notBefore > last ? last : notBefore, Ints);
  };
  std::vector<float> depths(std::size_t{bufferEdge} * bufferEdge, none);
  std::vector<Drawn> drawn(lanes * points.size());
  std::size_t drawnCount = 0;
  for (const BufferPoints& four : points) {
    const Ints pixel = pixelsAlong(dotOf(four.offset, up)) * bufferEdge + pixelsAlong(dotOf(four.offset, right));
    const Floats depth = dotOf(four.offset, back), facing = dotOf(four.normal, back);
    for (std::size_t lane = 0; lane < lanes; ++lane) { // no branches: half of the points face away
      const bool isDrawn = facing[lane] >= 0;
      drawn[drawnCount] = {pixel[lane], depth[lane]};
      drawnCount += std::size_t{isDrawn};
      float& nearest = depths[static_cast<std::size_t>(pixel[lane])];
      nearest = std::max(nearest, isDrawn ? depth[lane] : none);
    }
  }
  drawn.resize(drawnCount);
  const auto visible = std::ranges::count_if(
      drawn, [&](Drawn one) { return one.depth >= depths[static_cast<std::size_t>(one.pixel)] - tolerance; });
  const auto covered = std::ranges::count_if(depths, [](float depth) { return depth > none; });
  return {static_cast<double>(visible) / static_cast<double>(lanes * points.size()),
          static_cast<double>(covered) / static_cast<double>(depths.size())};
}

/// The vertices that are farthest along the axes and diagonals of a mesh, or its first one: samples may miss thin tips.
std::vector<Vec3f> tipsOf(const Mesh& mesh) {
  if (mesh.positions.empty())
    return {};
  std::vector<Vec3f> directions; // one of each pair of opposite ones
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (9 * x + 3 * y + z > 0)
          directions.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  std::vector<Vec3f> tips(directions.size() * 2, mesh.positions.front());
  parallelFor(directions.size(), [&](std::size_t i) {
    Vec3f &highest = tips[2 * i], &lowest = tips[2 * i + 1];
    float max = dot(directions[i], highest), min = max;
    for (const Vec3f& position : mesh.positions) {
      const float along = dot(directions[i], position);
      if (along > max)
        max = along, highest = position;
      if (along < min)
        min = along, lowest = position;
    }
  });
  return tips;
}

/// Tips of shapes at the moments of an animation that move their Transforms, and the corners of the boxes that surround
/// shapes whose vertices move.
void addMoments(const Scene& scene, const std::vector<std::vector<Vec3f>>& tips, std::size_t instanceCount,
                ViewSamples& samples) {
  constexpr std::size_t pointCount = 400'000;
  const std::size_t maxMoments = std::clamp<std::size_t>(pointCount / (27 * (instanceCount + 1)), 3, 64);
  SceneGraph graph = scene.graph;
  const auto addPoint = [&](Vec3d point) {
    samples.outline.push_back(point);
    samples.moving.add(point);
  };
  const auto add = [&](const Pose& pose) {
    for (const auto& [node, transform] : pose.transforms)
      graph.nodes[node].content = transform;
    for (const ShapeInstance& instance : shapeInstances(graph)) {
      const Shape& shape = shapeOf(graph, instance.node);
      if (!isDrawable(instance.worldFromShape))
        continue;
      if (!shape.movingBox.empty())
        for (const Vec3d& corner : cornersOf(shape.movingBox))
          addPoint(instance.worldFromShape.point(corner));
      else if (!pose.transforms.empty())
        for (const Vec3f& tip : tips[shape.mesh])
          addPoint(instance.worldFromShape.point(Vec3d(tip)));
    }
    for (const auto& [node, transform] : pose.transforms)
      graph.nodes[node].content = scene.graph.nodes[node].content;
  };
  add({});
  for (const std::size_t node : nodesInOrder(scene.graph))
    if (std::holds_alternative<TimeSensor>(scene.graph.nodes[node].content))
      for (const double moment : momentsOf(scene.graph, node, maxMoments))
        add(poseAt(scene.graph, node, moment));
}

/// 1 for the front at a height of 20 degrees, less the farther a view is from it.
double preferenceFor(Candidate candidate) {
  const double fromFront = (1 - std::cos(candidate.azimuth * degree)) / 2; // 0 in front, 1 behind
  return 1 - 0.12 * fromFront - 0.002 * std::abs(candidate.elevation - 20);
}

struct RatedView {
  Candidate candidate;
  double score = 0; ///< 0 where nothing is visible
};

/// Views by what they show of the points, in proportion to the most that one of them shows.
std::vector<RatedView> rate(const std::vector<Candidate>& views, const std::vector<BufferPoints>& points) {
  std::vector<Visibility> seen(views.size());
  parallelFor(views.size(), [&](std::size_t i) { seen[i] = visibilityOf(points, directionOf(views[i])); });
  Visibility best;
  for (const Visibility& one : seen)
    best = {std::max(best.surface, one.surface), std::max(best.picture, one.picture)};
  std::vector<RatedView> rated;
  for (std::size_t i = 0; i < views.size(); ++i)
    rated.push_back({views[i], best.surface > 0 ? (seen[i].surface / best.surface + seen[i].picture / best.picture) /
                                                      2 * preferenceFor(views[i])
                                                : 0});
  return rated;
}

} // namespace

ViewSamples viewSamplesOf(const Scene& scene, const StoredMeshes* stored) {
  constexpr std::size_t sampleCount = 20'000, maxInstances = 50'000;
  ViewSamples samples{surfaceSamples(scene, sampleCount, stored), {}, {}};
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  if (instances.size() > maxInstances)
    return samples;
  const SceneMeshes meshes(scene.meshes, stored);
  std::vector<std::vector<Vec3f>> tips(meshes.size());
  parallelFor(meshes.size(), [&](std::size_t i) { tips[i] = tipsOf(*meshes[i]); });
  for (const SurfaceSample& sample : samples.surface)
    samples.outline.push_back(sample.point);
  for (const ShapeInstance& instance : instances)
    if (isDrawable(instance.worldFromShape))
      for (const Vec3f& tip : tips[shapeOf(scene.graph, instance.node).mesh])
        samples.outline.push_back(instance.worldFromShape.point(Vec3d(tip)));
  addMoments(scene, tips, instances.size(), samples);
  return samples;
}

Vec3d directionOf(StartView view) {
  switch (view) {
  case StartView::left:
    return {-1, 0, 0};
  case StartView::right:
    return {1, 0, 0};
  case StartView::back:
    return {0, 0, -1};
  case StartView::top:
    return {0, 1, 0};
  case StartView::bottom:
    return {0, -1, 0};
  case StartView::front:
  case StartView::automatic:
    break;
  }
  return {0, 0, 1};
}

Vec3d bestDirection(const std::vector<SurfaceSample>& samples) {
  const std::vector<Candidate> list = candidates();
  Box3d box;
  for (const SurfaceSample& sample : samples)
    box.add(sample.point);
  if (!(length(box.size()) > 0))
    return directionOf(Candidate{25, 20});
  const std::vector<BufferPoints> points = bufferPointsOf(samples, box);
  // Every fifth group of samples tells which views are far from the best: whole buffers of all views take 6 %
  // of the conversion of the bunny.
  constexpr std::size_t fewStride = 5, finalists = 8;
  std::vector<BufferPoints> few;
  for (std::size_t i = 0; i < points.size(); i += fewStride)
    few.push_back(points[i]);
  std::vector<RatedView> rated = rate(list, few);
  std::ranges::stable_sort(rated, std::ranges::greater(), &RatedView::score);
  std::vector<Candidate> best;
  for (const RatedView& view : rated | std::views::take(finalists))
    best.push_back(view.candidate);
  rated = rate(best, points);
  const auto chosen = std::ranges::max_element(rated, {}, &RatedView::score);
  return chosen->score > 0 ? directionOf(chosen->candidate) : directionOf(Candidate{25, 20}); // all may face away
}

} // namespace imgeo
