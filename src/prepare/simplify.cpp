#include "prepare/simplify.h"

#include "prepare/edge_collapse.h"
#include "prepare/vertex_clustering.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace imgeo {

namespace {

/// Number of clusters per requested triangle. A smaller number is faster and coarser: docs/decisions/compact.md.
constexpr std::size_t clustersPerTriangle = 1;

/// Maps lattice positions to points within -1 .. 1, and back.
class UnitFrame {
public:
  explicit UnitFrame(std::span<const Vec3u> positions) {
    for (const Vec3u& position : positions)
      box_.add(Vec3d(position));
    center_ = box_.center();
    scale_ = std::max(1.0, box_.longestEdge() / 2);
  }

  Vec3d pointOf(const Vec3u& position) const { return (Vec3d(position) - center_) * (1 / scale_); }
  double latticeArea(double area) const { return area * scale_ * scale_; }

  /// The nearest lattice position within the box of all positions.
  Vec3u nearest(Vec3d point) const {
    const Vec3d position = point * scale_ + center_;
    Vec3u nearest;
    for (int axis = 0; axis < 3; ++axis)
      nearest[axis] =
          static_cast<std::uint32_t>(std::clamp(std::floor(position[axis] + 0.5), box_.min[axis], box_.max[axis]));
    return nearest;
  }

private:
  Box3d box_;
  Vec3d center_;
  double scale_ = 1;
};

/// A triangle's vertices in ascending order, and whether sorting them has reversed its orientation.
struct SortedTriangle {
  std::uint64_t lower = 0; ///< the lower two vertices
  std::uint32_t highest = 0;
  std::uint32_t firstCorner = 0;
  bool isReversed = false;

  SortedTriangle(const std::uint32_t* corners, std::uint32_t corner) : firstCorner(corner) {
    std::uint32_t a = corners[0], b = corners[1], c = corners[2];
    const auto sortPair = [&](std::uint32_t& u, std::uint32_t& v) {
      if (u > v) {
        std::swap(u, v);
        isReversed = !isReversed;
      }
    };
    sortPair(a, b), sortPair(b, c), sortPair(a, b);
    lower = std::uint64_t{a} << 32 | b;
    highest = c;
  }

  bool hasSameVertices(const SortedTriangle& other) const { return lower == other.lower && highest == other.highest; }
  friend bool operator<(const SortedTriangle& a, const SortedTriangle& b) {
    return a.lower != b.lower       ? a.lower < b.lower
           : a.highest != b.highest ? a.highest < b.highest
                                    : a.firstCorner < b.firstCorner;
  }
};

/// Removes pairs of triangles that have the same vertices and opposite orientations.
void removeOppositePairs(std::vector<std::uint32_t>& corners, std::vector<std::uint32_t>& sources) {
  std::vector<SortedTriangle> triangles;
  triangles.reserve(corners.size() / 3);
  for (std::uint32_t corner = 0; corner < corners.size(); corner += 3)
    triangles.emplace_back(&corners[corner], corner);
  std::sort(triangles.begin(), triangles.end());
  std::vector<bool> isKept(triangles.size());
  for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    std::ptrdiff_t sum = 0;
    for (end = begin; end < triangles.size() && triangles[end].hasSameVertices(triangles[begin]); ++end)
      sum += triangles[end].isReversed ? -1 : 1;
    for (std::size_t i = begin; i < end && sum != 0; ++i)
      if (triangles[i].isReversed == (sum < 0)) {
        isKept[triangles[i].firstCorner / 3] = true;
        sum += sum < 0 ? 1 : -1;
      }
  }
  std::size_t kept = 0;
  for (std::size_t triangle = 0; triangle < isKept.size(); ++triangle) {
    if (!isKept[triangle])
      continue;
    std::copy_n(&corners[3 * triangle], 3, &corners[3 * kept]);
    sources[kept++] = sources[triangle];
  }
  corners.resize(3 * kept);
  sources.resize(kept);
}

struct TriangleNormals {
  std::vector<Vec3d> normals; ///< the length of each is twice the triangle's area
  double area = 0;            ///< of all triangles
};

TriangleNormals normalsOf(std::span<const Vec3d> points, std::span<const std::uint32_t> corners) {
  TriangleNormals result;
  result.normals.reserve(corners.size() / 3);
  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    const Vec3d a = points[corners[corner]];
    const Vec3d normal = cross(points[corners[corner + 1]] - a, points[corners[corner + 2]] - a);
    result.normals.push_back(normal);
    result.area += length(normal) / 2;
  }
  return result;
}

/// One vertex for each cluster: the mean of its vertices, with the planes of all their triangles.
CollapsingSurface surfaceOf(std::span<const Vec3d> points, std::span<const std::uint32_t> corners,
                            std::span<const Vec3d> normals, const std::vector<bool>& isFixed,
                            const VertexClusters& clusters) {
  CollapsingSurface surface;
  surface.vertices.resize(clusters.count);
  std::vector<std::uint32_t> memberCounts(clusters.count);
  for (std::uint32_t vertex = 0; vertex < points.size(); ++vertex) {
    CollapsingSurface::Vertex& cluster = surface.vertices[clusters.clusterOf[vertex]];
    if (memberCounts[clusters.clusterOf[vertex]]++ == 0)
      cluster.source = vertex;
    cluster.position += points[vertex];
    cluster.isFixed = cluster.isFixed || isFixed[vertex];
  }
  for (std::uint32_t cluster = 0; cluster < clusters.count; ++cluster)
    surface.vertices[cluster].position = surface.vertices[cluster].position * (1.0 / memberCounts[cluster]);

  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    const Vec3d normal = normals[corner / 3];
    const double twiceArea = length(normal);
    const std::uint32_t u = clusters.clusterOf[corners[corner]], v = clusters.clusterOf[corners[corner + 1]],
                        w = clusters.clusterOf[corners[corner + 2]];
    if (twiceArea > 0 && u == v && v == w) {
      surface.vertices[u].quadric.addPlane(normal * (1 / twiceArea), points[corners[corner]], 3 * twiceArea);
    } else if (twiceArea > 0) {
      Quadric plane;
      plane.addPlane(normal * (1 / twiceArea), points[corners[corner]], twiceArea);
      for (const std::uint32_t cluster : {u, v, w})
        surface.vertices[cluster].quadric += plane;
    }
    if (u == v || v == w || w == u)
      continue;
    surface.corners.insert(surface.corners.end(), {u, v, w});
    surface.sources.push_back(static_cast<std::uint32_t>(corner / 3));
  }
  if (clusters.count < points.size())
    removeOppositePairs(surface.corners, surface.sources);
  return surface;
}

/// The remaining triangles and their vertices, on the lattice.
SimplifiedTriangles resultOf(const CollapsingSurface& surface, const UnitFrame& frame, std::span<const Vec3u> positions,
                             const VertexClusters& clusters) {
  constexpr std::uint32_t none = SimplifiedTriangles::none;
  SimplifiedTriangles result;
  result.triangles = surface.sources;
  std::vector<std::uint32_t> resultIndices(surface.vertices.size(), none);
  for (const std::uint32_t vertex : surface.corners) {
    if (resultIndices[vertex] == none) {
      resultIndices[vertex] = static_cast<std::uint32_t>(result.positions.size());
      const CollapsingSurface::Vertex& merged = surface.vertices[vertex];
      result.positions.push_back(merged.isFixed ? positions[merged.source] : frame.nearest(merged.position));
    }
    result.corners.push_back(resultIndices[vertex]);
  }
  result.vertexOfInput.reserve(positions.size());
  for (std::uint32_t vertex : clusters.clusterOf) {
    while (surface.vertices[vertex].mergedInto != CollapsingSurface::none)
      vertex = surface.vertices[vertex].mergedInto;
    result.vertexOfInput.push_back(resultIndices[vertex]);
  }
  return result;
}

} // namespace

SimplifiedTriangles simplify(std::span<const Vec3u> positions, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& isFixed, std::size_t triangleCount, CollapseOrder order) {
  const UnitFrame frame(positions);
  std::vector<Vec3d> points;
  points.reserve(positions.size());
  for (const Vec3u& position : positions)
    points.push_back(frame.pointOf(position));
  const std::size_t clusterCount = clustersPerTriangle * triangleCount;
  const auto [normals, area] = normalsOf(points, corners);
  const VertexClusters clusters = order == CollapseOrder::quadric && positions.size() > 2 * clusterCount
                                      ? clusterVertices(points, corners, normals, area, isFixed, clusterCount)
                                      : singletonClusters(positions.size());
  CollapsingSurface surface = surfaceOf(points, corners, normals, isFixed, clusters);
  if (clusters.count < positions.size())
    for (CollapsingSurface::Vertex& vertex : surface.vertices)
      if (!vertex.isFixed)
        vertex.position = vertex.quadric.minimizerNear(vertex.position);
  collapseEdges(surface, triangleCount, order);
  SimplifiedTriangles result = resultOf(surface, frame, positions, clusters);
  result.inputArea = frame.latticeArea(area);
  return result;
}

} // namespace imgeo
