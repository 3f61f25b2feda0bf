#include "prepare/vertex_clustering.h"

#include "prepare/index_hash_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// By vertex: the area-weighted sum of its triangles' normals.
std::vector<Vec3d> sumNormals(std::size_t vertexCount, std::span<const std::uint32_t> corners,
                              std::span<const Vec3d> normals) {
  std::vector<Vec3d> normalSums(vertexCount);
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
    normalSums[corners[corner]] += normals[corner / 3];
  return normalSums;
}

/// Key of a grid cell and an octant of directions, of 63 bits; points are within -1 .. 1.
std::uint64_t clusterKey(Vec3d point, Vec3d normal, double cellsPerUnit) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::uint64_t>((point[axis] + 1) * cellsPerUnit);
    key = key << 20 | std::min<std::uint64_t>(cell, 0xfffff);
  }
  for (int axis = 0; axis < 3; ++axis)
    key = key << 1 | std::uint64_t{normal[axis] < 0};
  return key;
}

} // namespace

VertexClusters singletonClusters(std::size_t vertexCount) {
  VertexClusters clusters{std::vector<std::uint32_t>(vertexCount), static_cast<std::uint32_t>(vertexCount)};
  std::iota(clusters.clusterOf.begin(), clusters.clusterOf.end(), 0u);
  return clusters;
}

VertexClusters clusterVertices(std::span<const Vec3d> points, std::span<const std::uint32_t> corners,
                               std::span<const Vec3d> normals, double area, const std::vector<bool>& isFixed,
                               std::size_t clusterCount) {
  const std::vector<Vec3d> normalSums = sumNormals(points.size(), corners, normals);
  const double cellsPerUnit = area > 0 ? std::sqrt(static_cast<double>(clusterCount) / area) : 1;

  VertexClusters clusters{std::vector<std::uint32_t>(points.size()), 0};
  std::vector<std::uint64_t> keys; // by cluster
  keys.reserve(points.size());
  IndexHashTable table(points.size());
  for (std::size_t vertex = 0; vertex < points.size(); ++vertex) {
    const std::uint64_t key = // the highest bit is set for fixed vertices alone
        isFixed[vertex] ? ~std::uint64_t{vertex} : clusterKey(points[vertex], normalSums[vertex], cellsPerUnit);
    const std::uint32_t cluster =
        table.findOrInsert(mixHash(0, key), clusters.count, [&](std::uint32_t i) { return keys[i] == key; });
    if (cluster == clusters.count) {
      keys.push_back(key);
      ++clusters.count;
    }
    clusters.clusterOf[vertex] = cluster;
  }
  return clusters;
}

} // namespace imgeo
