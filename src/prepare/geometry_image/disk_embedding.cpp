#include "prepare/geometry_image/disk_embedding.h"

#include "base/narrow.h"

// The same sums on machines of all vector widths.
#define EIGEN_DONT_VECTORIZE
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

constexpr std::uint32_t noVertex = noHalfEdge;

/// Improvements of the stretch that are worth another system of equations, and how many are tried.
constexpr double worthwhileImprovement = 0.99;
constexpr int maxImprovements = 8;

/// A corner of a divided triangle.
struct PartCorner {
  std::uint32_t vertex = 0;
  Vec3d weights;
};

Vec3d middle(const Vec3d& a, const Vec3d& b) {
  return (a + b) * 0.5;
}

/// Divides the triangles of a disk at the middles of edges.
class DiskMeshBuilder {
public:
  DiskMeshBuilder(const Mesh& mesh, const Chart& chart)
      : chart_(chart), middles_(chart.corners.size(), noVertex), isOnBoundary_(chart.vertexCount()) {
    for (const std::uint32_t position : chart.positions)
      disk_.points.emplace_back(mesh.positions[position]);
    for (const std::uint32_t halfEdge : boundaryOf(chart)) {
      disk_.boundary.push_back(chart.corners[halfEdge]);
      isOnBoundary_[chart.corners[halfEdge]] = true;
    }
  }

  DiskMesh build() && {
    divideEdges();
    for (std::uint32_t t = 0; t < chart_.triangleCount(); ++t)
      addTriangle(t);
    return std::move(disk_);
  }

private:
  void divideEdges() {
    for (std::uint32_t h = 0; h < middles_.size(); ++h) {
      const std::uint32_t o = chart_.opposites[h], from = chart_.corners[h], to = chart_.corners[nextHalfEdge(h)];
      if (o == noHalfEdge || o < h || !isOnBoundary_[from] || !isOnBoundary_[to])
        continue;
      middles_[h] = middles_[o] = addPoint(middle(disk_.points[from], disk_.points[to]));
    }
  }

  void addTriangle(std::uint32_t t) {
    constexpr std::array<Vec3d, 3> unit{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    std::vector<PartCorner> polygon;
    for (std::uint32_t s = 0; s < 3; ++s) {
      polygon.push_back({chart_.corners[3 * t + s], unit[s]});
      if (middles_[3 * t + s] != noVertex)
        polygon.push_back({middles_[3 * t + s], middle(unit[s], unit[(s + 1) % 3])});
    }
    if (polygon.size() == 3)
      return addPart(t, polygon[0], polygon[1], polygon[2]);
    PartCorner center{0, {1.0 / 3, 1.0 / 3, 1.0 / 3}};
    Vec3d sum;
    for (std::uint32_t s = 0; s < 3; ++s)
      sum += disk_.points[chart_.corners[3 * t + s]];
    center.vertex = addPoint(sum * (1.0 / 3));
    for (std::size_t i = 0; i < polygon.size(); ++i)
      addPart(t, polygon[i], polygon[(i + 1) % polygon.size()], center);
  }

  void addPart(std::uint32_t t, const PartCorner& a, const PartCorner& b, const PartCorner& c) {
    disk_.corners.insert(disk_.corners.end(), {a.vertex, b.vertex, c.vertex});
    disk_.triangles.push_back(t);
    disk_.weights.push_back({a.weights, b.weights, c.weights});
  }

  std::uint32_t addPoint(Vec3d point) {
    disk_.points.push_back(point);
    return narrow<std::uint32_t>(disk_.points.size() - 1);
  }

  const Chart& chart_;
  std::vector<std::uint32_t> middles_; ///< by half-edge: the vertex in its middle
  std::vector<bool> isOnBoundary_;     ///< by vertex
  DiskMesh disk_;
};

/// tan(angle / 2) between two vectors, for weights that are finite and greater than 0.
double halfAngleTangent(Vec3d a, Vec3d b) {
  const double sine = length(cross(a, b)), difference = length(a) * length(b) - dot(a, b);
  return std::clamp(sine > 0 ? difference / sine : difference > 0 ? 1e4 : 1e-4, 1e-4, 1e4);
}

EdgeWeights meanValueWeights(const DiskMesh& disk) {
  Box3d box;
  for (const Vec3d& point : disk.points)
    box.add(point);
  const double shortest = std::max(1e-9 * box.longestEdge(), std::numeric_limits<double>::min());
  EdgeWeights weights{std::vector<double>(disk.corners.size()), std::vector<double>(disk.corners.size())};
  for (std::uint32_t h = 0; h < disk.corners.size(); ++h) {
    const Vec3d from = disk.points[disk.corners[h]], to = disk.points[disk.corners[nextHalfEdge(h)]],
                across = disk.points[disk.corners[previousHalfEdge(h)]];
    const double edge = std::max(length(to - from), shortest);
    // Half of each mean value weight: the triangle on the other side of the edge has the other half.
    weights.forward[h] = halfAngleTangent(to - from, across - from) / edge;
    weights.backward[h] = halfAngleTangent(from - to, across - to) / edge;
  }
  return weights;
}

/// The mean square of the lengths that unit vectors of the plane have on the surface (Sander et al. 2001), and the area
/// of the triangle on the surface.
struct TriangleStretch {
  double square = 0, area = 0;
};

TriangleStretch stretchOf(const DiskMesh& disk, const std::vector<Vec2d>& points, std::size_t triangle,
                          double smallestArea) {
  const std::uint32_t* corners = &disk.corners[3 * triangle];
  const Vec3d &a = disk.points[corners[0]], &b = disk.points[corners[1]], &c = disk.points[corners[2]];
  const Vec2d &p = points[corners[0]], &q = points[corners[1]], &r = points[corners[2]];
  const double doubled = std::abs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y));
  const double scale = 1 / std::max(doubled, smallestArea);
  const Vec3d along = (a * (q.y - r.y) + b * (r.y - p.y) + c * (p.y - q.y)) * scale,
              down = (a * (r.x - q.x) + b * (p.x - r.x) + c * (q.x - p.x)) * scale;
  return {(dot(along, along) + dot(down, down)) / 2, length(cross(b - a, c - a)) / 2};
}

double signedAreaOf(const DiskMesh& disk, const std::vector<Vec2d>& points) {
  double doubled = 0;
  for (std::size_t i = 0; i < disk.boundary.size(); ++i) {
    const Vec2d &p = points[disk.boundary[i]], &q = points[disk.boundary[(i + 1) % disk.boundary.size()]];
    doubled += p.x * q.y - q.x * p.y;
  }
  return doubled / 2;
}

/// Divides the weight of each neighbour by the stretch around it.
EdgeWeights improved(const DiskMesh& disk, const std::vector<Vec2d>& points, EdgeWeights weights) {
  const double smallestArea = 1e-12 * std::abs(signedAreaOf(disk, points));
  std::vector<double> squares(disk.points.size()), areas(disk.points.size());
  for (std::size_t t = 0; t < disk.triangleCount(); ++t) {
    const TriangleStretch stretch = stretchOf(disk, points, t, smallestArea);
    for (std::uint32_t s = 0; s < 3; ++s) {
      squares[disk.corners[3 * t + s]] += stretch.square * stretch.area;
      areas[disk.corners[3 * t + s]] += stretch.area;
    }
  }
  const auto stretchAt = [&](std::uint32_t vertex) {
    return areas[vertex] > 0 && squares[vertex] > 0 ? std::sqrt(squares[vertex] / areas[vertex]) : 1;
  };
  for (std::uint32_t h = 0; h < disk.corners.size(); ++h) {
    weights.forward[h] /= stretchAt(disk.corners[nextHalfEdge(h)]);
    weights.backward[h] /= stretchAt(disk.corners[h]);
  }
  return weights;
}

} // namespace

DiskMesh diskMeshOf(const Mesh& mesh, const Chart& disk) {
  return DiskMeshBuilder(mesh, disk).build();
}

double stretchOf(const DiskMesh& disk, const std::vector<Vec2d>& points) {
  const double planeArea = std::abs(signedAreaOf(disk, points));
  double square = 0, area = 0;
  for (std::size_t t = 0; t < disk.triangleCount(); ++t) {
    const TriangleStretch stretch = stretchOf(disk, points, t, 1e-12 * planeArea);
    square += stretch.square * stretch.area;
    area += stretch.area;
  }
  return area > 0 ? std::sqrt(square * planeArea) / area : 1;
}

std::vector<Vec2d> solve(const DiskMesh& disk, std::span<const Vec2d> boundary, const EdgeWeights& weights,
                         const std::vector<Vec2d>& guess) {
  assert(boundary.size() == disk.boundary.size());
  std::vector<Vec2d> points(disk.points.size());
  std::vector<std::uint32_t> unknowns(disk.points.size(), 0);
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    points[disk.boundary[i]] = boundary[i];
    unknowns[disk.boundary[i]] = noVertex;
  }
  std::vector<std::uint32_t> vertices; // by unknown
  for (std::uint32_t v = 0; v < unknowns.size(); ++v)
    if (unknowns[v] != noVertex) {
      unknowns[v] = narrow<std::uint32_t>(vertices.size());
      vertices.push_back(v);
    }
  if (vertices.empty())
    return points;

  const auto count = static_cast<Eigen::Index>(vertices.size());
  std::vector<double> sums(vertices.size());
  const auto forEachWeight = [&](auto visit) { // visit(unknown, neighbour, weight)
    for (std::uint32_t h = 0; h < disk.corners.size(); ++h) {
      const std::uint32_t from = disk.corners[h], to = disk.corners[nextHalfEdge(h)];
      if (unknowns[from] != noVertex)
        visit(unknowns[from], to, weights.forward[h]);
      if (unknowns[to] != noVertex)
        visit(unknowns[to], from, weights.backward[h]);
    }
  };
  forEachWeight([&](std::uint32_t unknown, std::uint32_t, double weight) { sums[unknown] += weight; });
  std::vector<Eigen::Triplet<double>> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2), start(count, 2);
  for (std::size_t unknown = 0; unknown < vertices.size(); ++unknown) {
    entries.emplace_back(static_cast<int>(unknown), static_cast<int>(unknown), 1);
    const Vec2d point = guess.empty() ? Vec2d{} : guess[vertices[unknown]];
    start.row(static_cast<Eigen::Index>(unknown)) << point.x, point.y;
  }
  forEachWeight([&](std::uint32_t unknown, std::uint32_t neighbour, double weight) {
    const double share = weight / sums[unknown];
    if (unknowns[neighbour] != noVertex)
      entries.emplace_back(static_cast<int>(unknown), static_cast<int>(unknowns[neighbour]), -share);
    else
      right.row(unknown) += share * Eigen::RowVector2d(points[neighbour].x, points[neighbour].y);
  });
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::BiCGSTAB<Eigen::SparseMatrix<double, Eigen::RowMajor>, Eigen::IncompleteLUT<double>> solver;
  solver.preconditioner().setDroptol(1e-3);
  solver.setTolerance(1e-8);
  solver.compute(matrix);
  const Eigen::MatrixX2d solution = solver.solveWithGuess(right, start);
  for (std::size_t unknown = 0; unknown < vertices.size(); ++unknown) {
    const auto row = static_cast<Eigen::Index>(unknown);
    points[vertices[unknown]] = {solution(row, 0), solution(row, 1)};
  }
  return points;
}

DiskEmbedding embed(const DiskMesh& disk, std::span<const Vec2d> boundary) {
  DiskEmbedding best;
  best.weights = meanValueWeights(disk);
  best.points = solve(disk, boundary, best.weights, {});
  best.stretch = stretchOf(disk, best.points);
  for (int i = 0; i < maxImprovements; ++i) {
    DiskEmbedding next;
    next.weights = improved(disk, best.points, best.weights);
    next.points = solve(disk, boundary, next.weights, best.points);
    next.stretch = stretchOf(disk, next.points);
    if (!(next.stretch < best.stretch))
      break;
    const bool isWorthwhile = next.stretch < worthwhileImprovement * best.stretch;
    best = std::move(next);
    if (!isWorthwhile)
      break;
  }
  return best;
}

} // namespace imgeo
