#include "prepare/vertex_clustering.h"

#include "prepare/index_hash_table.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// Around each vertex.
std::vector<Vec3d> sumsOfNormals(std::size_t vertexCount, std::span<const std::uint32_t> corners,
                                 std::span<const Vec3d> normals) {
  std::vector<Vec3d> sums(vertexCount);
  for (std::size_t corner = 0; corner < corners.size(); ++corner)
    sums[corners[corner]] += normals[corner / 3];
  return sums;
}

/// A cell and an octant as one number; places are within -1 .. 1.
std::uint64_t keyOf(Vec3d place, Vec3d normal, double cellsPerUnit) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto cell = static_cast<std::uint64_t>((place[axis] + 1) * cellsPerUnit);
    key = key << 20 | std::min<std::uint64_t>(cell, 0xfffff);
  }
  for (int axis = 0; axis < 3; ++axis)
    key = key << 1 | std::uint64_t{normal[axis] < 0};
  return key;
}

} // namespace

VertexClusters singletonClusters(std::size_t vertexCount) {
  VertexClusters cells{std::vector<std::uint32_t>(vertexCount), static_cast<std::uint32_t>(vertexCount)};
  std::iota(cells.ofVertex.begin(), cells.ofVertex.end(), 0u);
  return cells;
}

VertexClusters clusterVertices(std::span<const Vec3d> places, std::span<const std::uint32_t> corners,
                               std::span<const Vec3d> normals, double area, const std::vector<bool>& isFixed,
                               std::size_t cellCount) {
  const std::vector<Vec3d> sums = sumsOfNormals(places.size(), corners, normals);
  const double cellsPerUnit = area > 0 ? std::sqrt(static_cast<double>(cellCount) / area) : 1;

  VertexClusters cells{std::vector<std::uint32_t>(places.size()), 0};
  std::vector<std::uint64_t> keys; // per cell
  keys.reserve(places.size());
  IndexHashTable table(places.size());
  for (std::size_t vertex = 0; vertex < places.size(); ++vertex) {
    const std::uint64_t key =
        isFixed[vertex] ? ~std::uint64_t{vertex} : keyOf(places[vertex], sums[vertex], cellsPerUnit);
    const std::uint32_t cell =
        table.findOrInsert(mixHash(0, key), cells.count, [&](std::uint32_t i) { return keys[i] == key; });
    if (cell == cells.count) {
      keys.push_back(key);
      ++cells.count;
    }
    cells.ofVertex[vertex] = cell;
  }
  return cells;
}

} // namespace imgeo
