#include "scene/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace imgeo {

namespace {

/// Points of the unit square that fill it evenly: multiples of the inverse plastic number and its square (Roberts 2018,
/// "The unreasonable effectiveness of quasirandom sequences").
class EvenPoints {
public:
  Vec2<double> next() {
    point_ = {std::fmod(point_.x + 0.7548776662466927, 1), std::fmod(point_.y + 0.5698402909980532, 1)};
    return point_;
  }

private:
  Vec2<double> point_{0.5, 0.5};
};

struct LocalSample {
  Vec3d point, edgeA, edgeB; ///< the edges of its triangle, which give the normal in world coordinates
  std::size_t firstCorner = 0;
  std::array<float, 3> weights;
};

/// Calls body(firstCorner, corners, size) for every element of a mesh: its area, its length, or 1 for a point.
template <typename Body> void forEachElement(const Mesh& mesh, Body&& body) {
  const std::uint32_t cornerCount = cornersPerElement(mesh.topology);
  for (std::size_t first = 0; first + cornerCount <= mesh.corners.size(); first += cornerCount) {
    std::array<Vec3d, 3> corners;
    for (std::uint32_t corner = 0; corner < 3; ++corner)
      corners[corner] = Vec3d(mesh.cornerPosition(first + std::min(corner, cornerCount - 1)));
    const Vec3d a = corners[1] - corners[0], b = corners[2] - corners[0];
    body(first, corners,
         mesh.topology == Topology::triangles ? length(cross(a, b)) / 2
         : mesh.topology == Topology::lines   ? length(a)
                                              : 1.0);
  }
}

double sizeOf(const Mesh& mesh) {
  double sum = 0;
  forEachElement(mesh, [&](std::size_t, const auto&, double size) { sum += size; });
  return sum;
}

/// About `count` samples of a mesh of size `sum`, as many per area everywhere.
std::vector<LocalSample> samplesOf(const Mesh& mesh, double sum, std::size_t count) {
  std::vector<LocalSample> samples;
  const double step = std::max(sum / static_cast<double>(count), mesh.topology == Topology::points ? 1.0 : 0.0);
  double carried = step / 2; // the part of a step that the elements before have left over
  EvenPoints even;
  forEachElement(mesh, [&](std::size_t first, const std::array<Vec3d, 3>& corners, double size) {
    const Vec3d a = corners[1] - corners[0], b = corners[2] - corners[0];
    carried += size;
    while (carried >= step) {
      carried -= step;
      Vec2<double> at = even.next();
      if (mesh.topology == Topology::triangles && at.x + at.y > 1)
        at = {1 - at.x, 1 - at.y};
      const double alongB = mesh.topology == Topology::triangles ? at.y : 0;
      const double alongA = mesh.topology == Topology::points ? 0 : at.x;
      samples.push_back(
          {corners[0] + a * alongA + b * alongB,
           a,
           b,
           first,
           {static_cast<float>(1 - alongA - alongB), static_cast<float>(alongA), static_cast<float>(alongB)}});
    }
  });
  return samples;
}

/// The factor by which a map changes sizes: exact where it scales all directions alike.
double sizeFactor(const Affine3d& map, Topology topology) {
  const double scale = std::cbrt(std::abs(map.determinant()));
  return topology == Topology::triangles ? scale * scale : topology == Topology::lines ? scale : 1;
}

SurfaceSample toWorld(const LocalSample& local, const ShapeInstance& instance, bool isSolid) {
  const Affine3d& worldFromShape = instance.worldFromShape;
  SurfaceSample sample{worldFromShape.point(local.point), {}, isSolid, instance.node, local.firstCorner, local.weights};
  const Vec3d normal = cross(worldFromShape.direction(local.edgeA), worldFromShape.direction(local.edgeB));
  if (const double normalLength = length(normal); normalLength > 0) // mirrored shapes keep their front side
    sample.normal = Vec3f(normal * ((worldFromShape.determinant() < 0 ? -1 : 1) / normalLength));
  return sample;
}

} // namespace

TopologySamples surfaceSamples(const Scene& scene, const std::vector<ShapeInstance>& instances, Topology topology,
                               std::size_t count) {
  std::vector<double> meshSizes(scene.meshes.size()), largestInstances(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    meshSizes[i] = scene.meshes[i].topology == topology ? sizeOf(scene.meshes[i]) : 0;
  const auto sizeOfInstance = [&](const ShapeInstance& instance) {
    const double size =
        meshSizes[shapeOf(scene.graph, instance.node).mesh] * sizeFactor(instance.worldFromShape, topology);
    return size > 0 && std::isfinite(size) && isDrawable(instance.worldFromShape) ? size : 0;
  };
  double sum = 0;
  for (const ShapeInstance& instance : instances) {
    double& largest = largestInstances[shapeOf(scene.graph, instance.node).mesh];
    largest = std::max(largest, sizeOfInstance(instance));
    sum += sizeOfInstance(instance);
  }
  if (!(sum > 0) || !std::isfinite(sum))
    return {};

  const double samplesPerSize = static_cast<double>(count) / sum;
  std::vector<std::vector<LocalSample>> ofMeshes(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (largestInstances[i] > 0)
      ofMeshes[i] = samplesOf(scene.meshes[i], meshSizes[i],
                              static_cast<std::size_t>(std::ceil(largestInstances[i] * samplesPerSize)));
  std::vector<SurfaceSample> samples;
  double carried = 0.5; // the part of a sample that the instances before have left over
  std::size_t offset = 0;
  for (const ShapeInstance& instance : instances) {
    const Shape& shape = shapeOf(scene.graph, instance.node);
    const std::vector<LocalSample>& locals = ofMeshes[shape.mesh];
    carried += sizeOfInstance(instance) * samplesPerSize;
    const std::size_t taken = std::min(static_cast<std::size_t>(carried), locals.size());
    carried -= std::floor(carried);
    for (std::size_t i = 0; i < taken; ++i) // the next instance begins elsewhere, so that few samples differ
      samples.push_back(toWorld(locals[(i * locals.size() / taken + offset) % locals.size()], instance,
                                shape.solid && topology == Topology::triangles));
    offset += 7;
  }
  return {std::move(samples), sum};
}

std::vector<SurfaceSample> surfaceSamples(const Scene& scene, std::size_t count) {
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  for (const Topology topology : {Topology::triangles, Topology::lines, Topology::points})
    if (TopologySamples some = surfaceSamples(scene, instances, topology, count); !some.samples.empty())
      return std::move(some.samples);
  return {};
}

} // namespace imgeo
