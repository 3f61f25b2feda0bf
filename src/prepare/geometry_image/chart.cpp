#include "prepare/geometry_image/chart.h"

#include "base/disjoint_sets.h"
#include "base/narrow.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

namespace imgeo {

namespace {

/// Half-edges 3t + s of all triangles t of the mesh; corners are half-edges as well: those that start at them.
struct Surface {
  const Mesh& mesh;
  std::vector<std::uint32_t> opposites; ///< noHalfEdge: the surface is not continued
};

bool isSmooth(Vec3f a, Vec3f b) {
  static const double smallestCosine = std::cos(30 * std::numbers::pi / 180);
  return dot(Vec3d(a), Vec3d(b)) >= smallestCosine;
}

/// Whether attributes are continuous from one wedge of a position to another.
bool isContinuous(const Mesh& mesh, std::uint32_t a, std::uint32_t b) {
  if (a == b)
    return true;
  for (std::size_t set = 0; set < texCoordSetCount(mesh); ++set)
    if (texCoordsOf(mesh, set)[a] != texCoordsOf(mesh, set)[b])
      return false;
  return mesh.normals.empty() || isSmooth(mesh.normals[a], mesh.normals[b]);
}

Surface surfaceOf(const Mesh& mesh) {
  std::vector<std::uint32_t> corners;
  corners.reserve(mesh.corners.size());
  for (const std::uint32_t wedge : mesh.corners)
    corners.push_back(mesh.wedgePositions[wedge]);
  Surface surface{mesh, oppositeHalfEdges(corners)};
  for (std::uint32_t h = 0; h < surface.opposites.size(); ++h) {
    const std::uint32_t o = surface.opposites[h];
    if (o == noHalfEdge || o < h)
      continue;
    if (!isContinuous(mesh, mesh.corners[h], mesh.corners[nextHalfEdge(o)]) &&
        !isContinuous(mesh, mesh.corners[nextHalfEdge(h)], mesh.corners[o]))
      surface.opposites[h] = surface.opposites[o] = noHalfEdge;
  }
  return surface;
}

bool isDegenerate(const Mesh& mesh, std::uint32_t triangle) {
  const auto position = [&](std::uint32_t s) { return mesh.wedgePositions[mesh.corners[3 * triangle + s]]; };
  return position(0) == position(1) || position(1) == position(2) || position(2) == position(0);
}

/// The chart of these triangles, whose half-edges have these opposites.
Chart chartOf(const Mesh& mesh, std::vector<std::uint32_t> triangles, std::vector<std::uint32_t> opposites) {
  Chart chart{.triangles = std::move(triangles), .corners = {}, .positions = {}, .opposites = std::move(opposites)};
  DisjointSets vertices(chart.opposites.size());
  for (std::uint32_t h = 0; h < chart.opposites.size(); ++h)
    if (const std::uint32_t o = chart.opposites[h]; o != noHalfEdge) {
      vertices.merge(h, nextHalfEdge(o));
      vertices.merge(nextHalfEdge(h), o);
    }
  std::vector<std::uint32_t> numbers(chart.opposites.size());
  for (std::uint32_t corner = 0; corner < numbers.size(); ++corner) {
    const std::uint32_t first = vertices.find(corner);
    if (first == corner) {
      numbers[corner] = narrow<std::uint32_t>(chart.positions.size());
      chart.positions.push_back(mesh.wedgePositions[mesh.corners[3 * chart.triangles[corner / 3] + corner % 3]]);
    }
    chart.corners.push_back(numbers[first]);
  }
  return chart;
}

Vec3d centroidOf(const Mesh& mesh, const Chart& chart, std::uint32_t triangle) {
  Vec3d sum;
  for (std::uint32_t s = 0; s < 3; ++s)
    sum += Vec3d(mesh.positions[chart.positions[chart.corners[3 * triangle + s]]]);
  return sum * (1.0 / 3);
}

/// The nearest of the start triangles of each triangle, along the surface, and the triangle that is reached last.
struct NearestStarts {
  std::vector<std::uint32_t> starts; ///< index of the start
  std::uint32_t last = 0;
};

NearestStarts nearestStarts(const Chart& chart, const std::vector<Vec3d>& centroids,
                            const std::vector<std::uint32_t>& startTriangles) {
  constexpr std::uint32_t none = noHalfEdge;
  struct Reached {
    double distance;
    std::uint32_t triangle, start;
    bool operator>(const Reached& other) const {
      return std::pair(distance, triangle) > std::pair(other.distance, other.triangle);
    }
  };
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> queue;
  for (std::uint32_t start = 0; start < startTriangles.size(); ++start)
    queue.push({0, startTriangles[start], start});
  NearestStarts result{std::vector<std::uint32_t>(chart.triangleCount(), none), 0};
  while (!queue.empty()) {
    const Reached reached = queue.top();
    queue.pop();
    if (result.starts[reached.triangle] != none)
      continue;
    result.starts[reached.triangle] = reached.start;
    result.last = reached.triangle;
    for (std::uint32_t h = 3 * reached.triangle; h < 3 * reached.triangle + 3; ++h)
      if (const std::uint32_t o = chart.opposites[h]; o != noHalfEdge && result.starts[o / 3] == none)
        queue.push({reached.distance + length(centroids[o / 3] - centroids[reached.triangle]), o / 3, reached.start});
  }
  return result;
}

/// The charts of triangles that have the same label, by label. `opposites` are those of the half-edges of `triangles`.
std::vector<Chart> byLabel(const Mesh& mesh, const std::vector<std::uint32_t>& triangles,
                           const std::vector<std::uint32_t>& opposites, const std::vector<std::uint32_t>& labels,
                           std::size_t labelCount) {
  std::vector<std::vector<std::uint32_t>> members(labelCount);
  std::vector<std::uint32_t> numbers(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (labels[t] < labelCount) {
      numbers[t] = narrow<std::uint32_t>(members[labels[t]].size());
      members[labels[t]].push_back(t);
    }
  std::vector<Chart> charts;
  for (const std::vector<std::uint32_t>& member : members) {
    std::vector<std::uint32_t> ownTriangles, ownOpposites;
    for (const std::uint32_t t : member) {
      ownTriangles.push_back(triangles[t]);
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t o = opposites[h];
        const bool isInside = o != noHalfEdge && labels[o / 3] == labels[t];
        ownOpposites.push_back(isInside ? 3 * numbers[o / 3] + o % 3 : noHalfEdge);
      }
    }
    charts.push_back(chartOf(mesh, std::move(ownTriangles), std::move(ownOpposites)));
  }
  return charts;
}

} // namespace

std::vector<Chart> chartsOf(const Mesh& mesh) {
  assert(mesh.topology == Topology::triangles);
  const Surface surface = surfaceOf(mesh);
  constexpr std::uint32_t none = noHalfEdge;
  std::vector<std::uint32_t> triangles(mesh.elementCount()), labels(triangles.size(), none);
  std::iota(triangles.begin(), triangles.end(), 0u);
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < triangles.size(); ++first) {
    if (labels[first] != none || isDegenerate(mesh, first))
      continue;
    std::vector<std::uint32_t> open{first};
    labels[first] = count;
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
        if (const std::uint32_t o = surface.opposites[h]; o != noHalfEdge && labels[o / 3] == none) {
          labels[o / 3] = count;
          open.push_back(o / 3);
        }
    }
    ++count;
  }
  return byLabel(mesh, triangles, surface.opposites, labels, count);
}

std::array<Chart, 2> divide(const Mesh& mesh, const Chart& chart) {
  assert(chart.triangleCount() >= 2);
  std::vector<Vec3d> centroids;
  for (std::uint32_t t = 0; t < chart.triangleCount(); ++t)
    centroids.push_back(centroidOf(mesh, chart, t));
  const std::uint32_t oneEnd = nearestStarts(chart, centroids, {0}).last;
  const std::uint32_t otherEnd = nearestStarts(chart, centroids, {oneEnd}).last;
  const NearestStarts halves = nearestStarts(chart, centroids, {oneEnd, otherEnd});
  std::vector<Chart> charts = byLabel(mesh, chart.triangles, chart.opposites, halves.starts, 2);
  return {std::move(charts[0]), std::move(charts[1])};
}

bool isDisk(const Chart& chart) {
  const auto boundaryEdges = std::ranges::count(chart.opposites, noHalfEdge);
  const auto edges = (static_cast<std::ptrdiff_t>(chart.opposites.size()) + boundaryEdges) / 2;
  return std::ssize(chart.positions) - edges + std::ssize(chart.triangles) == 1;
}

std::vector<std::uint32_t> boundaryOf(const Chart& disk) {
  assert(isDisk(disk));
  const auto first = narrow<std::uint32_t>(std::ranges::find(disk.opposites, noHalfEdge) - disk.opposites.begin());
  std::vector<std::uint32_t> boundary;
  std::uint32_t h = first;
  do {
    boundary.push_back(h);
    // Turns around the end of h, through the triangles at it, to the next edge without a triangle behind it.
    h = nextHalfEdge(h);
    while (disk.opposites[h] != noHalfEdge)
      h = nextHalfEdge(disk.opposites[h]);
  } while (h != first);
  return boundary;
}

} // namespace imgeo
