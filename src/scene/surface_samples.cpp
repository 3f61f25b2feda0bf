#include "scene/surface_samples.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace imgeo {

namespace {

/// Point `index` of those that fill the unit square evenly: multiples of the inverse plastic number and its square
/// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
Vec2<double> evenPoint(std::size_t index) {
  const auto multiple = static_cast<double>(index + 1);
  const auto fraction = [](double number) { return number - static_cast<double>(static_cast<std::int64_t>(number)); };
  return {fraction(0.5 + multiple * 0.7548776662466927), fraction(0.5 + multiple * 0.5698402909980532)};
}

/// A sample of a mesh: its element, and which of the even points it is.
struct LocalSample {
  std::size_t firstCorner = 0, number = 0;
};

/// The corners of an element; the last one repeated where there are fewer than three.
std::array<Vec3d, 3> cornersOf(const Mesh& mesh, std::size_t firstCorner) {
  const std::uint32_t cornerCount = cornersPerElement(mesh.topology);
  std::array<Vec3d, 3> corners;
  for (std::uint32_t corner = 0; corner < 3; ++corner)
    corners[corner] = Vec3d(mesh.cornerPosition(firstCorner + std::min(corner, cornerCount - 1)));
  return corners;
}

/// Elements that one thread measures or samples at a time.
constexpr std::size_t blockElements = 4096;

std::size_t blockCountOf(const Mesh& mesh) {
  return (mesh.elementCount() + blockElements - 1) / blockElements;
}

/// The area of an element, its length, or 1 for a point.
double sizeOf(const Mesh& mesh, std::size_t element) {
  if (mesh.topology == Topology::points)
    return 1;
  const std::size_t first = element * cornersPerElement(mesh.topology);
  const Vec3d origin(mesh.cornerPosition(first)), a = Vec3d(mesh.cornerPosition(first + 1)) - origin;
  if (mesh.topology == Topology::lines)
    return length(a);
  return length(cross(a, Vec3d(mesh.cornerPosition(first + 2)) - origin)) / 2;
}

/// The sizes of a mesh's elements.
struct ElementSizes {
  std::vector<double> ofElements;      ///< empty: to be computed again
  std::vector<double> beforeBlocks{0}; ///< up to the beginning of each block, and that of the whole mesh
};

ElementSizes sizesOf(const Mesh& mesh, bool keepsElements) {
  ElementSizes sizes;
  if (keepsElements)
    sizes.ofElements.resize(mesh.elementCount());
  sizes.beforeBlocks.resize(blockCountOf(mesh) + 1);
  parallelFor(blockCountOf(mesh), [&](std::size_t block) {
    const std::size_t end = std::min(mesh.elementCount(), (block + 1) * blockElements);
    double sum = 0;
    for (std::size_t element = block * blockElements; element < end; ++element) {
      const double size = sizeOf(mesh, element);
      sum += size;
      if (keepsElements)
        sizes.ofElements[element] = size;
    }
    sizes.beforeBlocks[block + 1] = sum;
  });
  std::partial_sum(sizes.beforeBlocks.begin(), sizes.beforeBlocks.end(), sizes.beforeBlocks.begin());
  return sizes;
}

/// About `count` samples of a mesh, as many per area everywhere: one in the middle of each step.
std::vector<LocalSample> samplesOf(const Mesh& mesh, const ElementSizes& sizes, std::size_t count) {
  const double size = sizes.beforeBlocks.back();
  const double step = std::max(size / static_cast<double>(count), mesh.topology == Topology::points ? 1.0 : 0.0);
  const auto samplesUpTo = [&](double reached) { return static_cast<std::size_t>(reached / step + 0.5); };
  std::vector<LocalSample> samples(samplesUpTo(size));
  parallelFor(sizes.beforeBlocks.size() - 1, [&](std::size_t block) {
    std::size_t next = samplesUpTo(sizes.beforeBlocks[block]);
    const std::size_t end = samplesUpTo(sizes.beforeBlocks[block + 1]);
    if (next == end)
      return;
    double reached = sizes.beforeBlocks[block];
    const std::size_t lastElement = std::min(mesh.elementCount(), (block + 1) * blockElements) - 1;
    for (std::size_t element = block * blockElements; element <= lastElement; ++element) {
      reached += sizes.ofElements.empty() ? sizeOf(mesh, element) : sizes.ofElements[element];
      // The last element takes what rounding leaves over.
      const std::size_t reachedCount = element == lastElement ? end : std::min(end, samplesUpTo(reached));
      for (; next < reachedCount; ++next)
        samples[next] = {element * cornersPerElement(mesh.topology), next};
    }
  });
  return samples;
}

/// The factor by which a map changes sizes: exact where it scales all directions alike.
double sizeFactor(const Affine3d& map, Topology topology) {
  const double scale = std::cbrt(std::abs(map.determinant()));
  return topology == Topology::triangles ? scale * scale : topology == Topology::lines ? scale : 1;
}

SurfaceSample toWorld(const Mesh& mesh, const LocalSample& local, const ShapeInstance& instance, bool isSolid) {
  const std::array<Vec3d, 3> corners = cornersOf(mesh, local.firstCorner);
  const Vec3d a = corners[1] - corners[0], b = corners[2] - corners[0];
  Vec2<double> at = evenPoint(local.number);
  if (mesh.topology == Topology::triangles && at.x + at.y > 1)
    at = {1 - at.x, 1 - at.y};
  const double alongB = mesh.topology == Topology::triangles ? at.y : 0;
  const double alongA = mesh.topology == Topology::points ? 0 : at.x;
  const Affine3d& worldFromShape = instance.worldFromShape;
  SurfaceSample sample{
      worldFromShape.point(corners[0] + a * alongA + b * alongB),
      {},
      isSolid,
      instance.node,
      local.firstCorner,
      {static_cast<float>(1 - alongA - alongB), static_cast<float>(alongA), static_cast<float>(alongB)}};
  const Vec3d normal = cross(worldFromShape.direction(a), worldFromShape.direction(b));
  if (const double normalLength = length(normal); normalLength > 0) // mirrored shapes keep their front side
    sample.normal = Vec3f(normal * ((worldFromShape.determinant() < 0 ? -1 : 1) / normalLength));
  return sample;
}

} // namespace

TopologySamples surfaceSamples(const Scene& scene, const std::vector<ShapeInstance>& instances, Topology topology,
                               std::size_t count, const StoredMeshes* stored) {
  const SceneMeshes meshes(scene.meshes, stored);
  std::vector<ElementSizes> sizes(scene.meshes.size());
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    if (meshes.partOf(i).topology == topology)
      sizes[i] = sizesOf(*meshes[i], !meshes.isStored(i));
  std::vector<double> largestInstances(scene.meshes.size());
  const auto sizeOfInstance = [&](const ShapeInstance& instance) {
    const double size = sizes[shapeOf(scene.graph, instance.node).mesh].beforeBlocks.back() *
                        sizeFactor(instance.worldFromShape, topology);
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
      ofMeshes[i] =
          samplesOf(*meshes[i], sizes[i], static_cast<std::size_t>(std::ceil(largestInstances[i] * samplesPerSize)));
  std::vector<SurfaceSample> samples;
  double carried = 0.5; // the part of a sample that the instances before have left over
  std::size_t offset = 0;
  for (const ShapeInstance& instance : instances) {
    const Shape& shape = shapeOf(scene.graph, instance.node);
    const std::vector<LocalSample>& locals = ofMeshes[shape.mesh];
    carried += sizeOfInstance(instance) * samplesPerSize;
    const std::size_t taken = std::min(static_cast<std::size_t>(carried), locals.size());
    carried -= std::floor(carried);
    samples.reserve(std::max(samples.size() + taken, count));
    const MeshHandle mesh = taken > 0 ? meshes[shape.mesh] : MeshHandle(meshes.partOf(shape.mesh));
    for (std::size_t i = 0; i < taken; ++i) // the next instance begins elsewhere, so that few samples differ
      samples.push_back(toWorld(*mesh, locals[(i * locals.size() / taken + offset) % locals.size()], instance,
                                shape.solid && topology == Topology::triangles));
    offset += 7;
  }
  return {std::move(samples), sum};
}

std::vector<SurfaceSample> surfaceSamples(const Scene& scene, std::size_t count, const StoredMeshes* stored) {
  const std::vector<ShapeInstance> instances = shapeInstances(scene.graph);
  for (const Topology topology : {Topology::triangles, Topology::lines, Topology::points})
    if (TopologySamples some = surfaceSamples(scene, instances, topology, count, stored); !some.samples.empty())
      return std::move(some.samples);
  return {};
}

} // namespace imgeo
