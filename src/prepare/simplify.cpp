#include "prepare/simplify.h"

#include "prepare/edge_collapse.h"
#include "prepare/vertex_clustering.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace imgeo {

namespace {

/// Cells for each triangle that is wanted, where there are many more to begin with.
/// Fewer are faster and coarser: docs/decisions/compact.md.
constexpr std::size_t cellsPerTriangle = 1;

/// Lattice positions <-> places within -1 .. 1, where numbers have their digits to spare.
class UnitFrame {
public:
  explicit UnitFrame(std::span<const Vec3u> positions) {
    for (const Vec3u& position : positions)
      box_.add(Vec3d(position));
    center_ = box_.center();
    scale_ = std::max(1.0, box_.longestEdge() / 2);
  }

  Vec3d positionOf(const Vec3u& position) const { return (Vec3d(position) - center_) * (1 / scale_); }
  double latticeArea(double area) const { return area * scale_ * scale_; }

  /// Within the box of the positions.
  Vec3u nearest(Vec3d place) const {
    const Vec3d position = place * scale_ + center_;
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

/// A triangle as its vertices in ascending order, and whether it goes round that way.
struct FoldedTriangle {
  std::uint64_t lower = 0; ///< the first two vertices
  std::uint32_t highest = 0, place = 0;
  bool isTurned = false;

  FoldedTriangle(const std::uint32_t* corners, std::uint32_t at) : place(at) {
    std::uint32_t a = corners[0], b = corners[1], c = corners[2];
    const auto put = [&](std::uint32_t& u, std::uint32_t& v) {
      if (u > v) {
        std::swap(u, v);
        isTurned = !isTurned;
      }
    };
    put(a, b), put(b, c), put(a, b);
    lower = std::uint64_t{a} << 32 | b;
    highest = c;
  }

  bool isOver(const FoldedTriangle& other) const { return lower == other.lower && highest == other.highest; }
  friend bool operator<(const FoldedTriangle& a, const FoldedTriangle& b) {
    return a.lower != b.lower ? a.lower < b.lower : a.highest != b.highest ? a.highest < b.highest : a.place < b.place;
  }
};

/// Drops triangles in pairs that have come to lie back to back.
void dropFolds(std::vector<std::uint32_t>& corners, std::vector<std::uint32_t>& sources) {
  std::vector<FoldedTriangle> triangles;
  triangles.reserve(corners.size() / 3);
  for (std::uint32_t at = 0; at < corners.size(); at += 3)
    triangles.emplace_back(&corners[at], at);
  std::sort(triangles.begin(), triangles.end());
  std::vector<bool> isKept(triangles.size());
  for (std::size_t begin = 0, end = 0; begin < triangles.size(); begin = end) {
    std::ptrdiff_t sum = 0;
    for (end = begin; end < triangles.size() && triangles[end].isOver(triangles[begin]); ++end)
      sum += triangles[end].isTurned ? -1 : 1;
    for (std::size_t i = begin; i < end && sum != 0; ++i)
      if (triangles[i].isTurned == (sum < 0)) {
        isKept[triangles[i].place / 3] = true;
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
  std::vector<Vec3d> normals; ///< each as long as twice the triangle's area
  double area = 0;            ///< of all
};

TriangleNormals normalsOf(std::span<const Vec3d> places, std::span<const std::uint32_t> corners) {
  TriangleNormals result;
  result.normals.reserve(corners.size() / 3);
  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    const Vec3d a = places[corners[corner]];
    const Vec3d normal = cross(places[corners[corner + 1]] - a, places[corners[corner + 2]] - a);
    result.normals.push_back(normal);
    result.area += length(normal) / 2;
  }
  return result;
}

/// One vertex a cell, in the middle of its vertices, with the planes of all their triangles.
CollapsingSurface surfaceOf(std::span<const Vec3d> places, std::span<const std::uint32_t> corners,
                            std::span<const Vec3d> normals, const std::vector<bool>& isFixed,
                            const VertexClusters& cells) {
  CollapsingSurface surface;
  surface.vertices.resize(cells.count);
  std::vector<std::uint32_t> members(cells.count);
  for (std::uint32_t vertex = 0; vertex < places.size(); ++vertex) {
    CollapsingSurface::Vertex& cell = surface.vertices[cells.ofVertex[vertex]];
    if (members[cells.ofVertex[vertex]]++ == 0)
      cell.source = vertex;
    cell.place += places[vertex];
    cell.isFixed = cell.isFixed || isFixed[vertex];
  }
  for (std::uint32_t cell = 0; cell < cells.count; ++cell)
    surface.vertices[cell].place = surface.vertices[cell].place * (1.0 / members[cell]);

  for (std::size_t corner = 0; corner < corners.size(); corner += 3) {
    const Vec3d normal = normals[corner / 3];
    const double size = length(normal);
    const std::uint32_t u = cells.ofVertex[corners[corner]], v = cells.ofVertex[corners[corner + 1]],
                        w = cells.ofVertex[corners[corner + 2]];
    if (size > 0 && u == v && v == w) { // most triangles
      surface.vertices[u].quadric.addPlane(normal * (1 / size), places[corners[corner]], 3 * size);
    } else if (size > 0) {
      Quadric plane;
      plane.addPlane(normal * (1 / size), places[corners[corner]], size);
      for (const std::uint32_t cell : {u, v, w})
        surface.vertices[cell].quadric += plane;
    }
    if (u == v || v == w || w == u)
      continue;
    surface.corners.insert(surface.corners.end(), {u, v, w});
    surface.sources.push_back(static_cast<std::uint32_t>(corner / 3));
  }
  if (cells.count < places.size())
    dropFolds(surface.corners, surface.sources);
  return surface;
}

/// The vertices that are in use, on the lattice.
SimplifiedTriangles resultOf(const CollapsingSurface& surface, const UnitFrame& frame, std::span<const Vec3u> positions,
                             const VertexClusters& cells) {
  constexpr std::uint32_t none = SimplifiedTriangles::none;
  SimplifiedTriangles result;
  result.triangles = surface.sources;
  std::vector<std::uint32_t> numbers(surface.vertices.size(), none);
  for (const std::uint32_t vertex : surface.corners) {
    if (numbers[vertex] == none) {
      numbers[vertex] = static_cast<std::uint32_t>(result.positions.size());
      const CollapsingSurface::Vertex& from = surface.vertices[vertex];
      result.positions.push_back(from.isFixed ? positions[from.source] : frame.nearest(from.place));
    }
    result.corners.push_back(numbers[vertex]);
  }
  result.vertexOfInput.reserve(positions.size());
  for (std::uint32_t vertex : cells.ofVertex) {
    while (surface.vertices[vertex].became != CollapsingSurface::none)
      vertex = surface.vertices[vertex].became;
    result.vertexOfInput.push_back(numbers[vertex]);
  }
  return result;
}

} // namespace

SimplifiedTriangles simplify(std::span<const Vec3u> positions, std::span<const std::uint32_t> corners,
                             const std::vector<bool>& isFixed, std::size_t triangleCount) {
  const UnitFrame frame(positions);
  std::vector<Vec3d> places;
  places.reserve(positions.size());
  for (const Vec3u& position : positions)
    places.push_back(frame.positionOf(position));
  const std::size_t cellCount = cellsPerTriangle * triangleCount;
  const auto [normals, area] = normalsOf(places, corners);
  const VertexClusters cells = positions.size() > 2 * cellCount
                                   ? clusterVertices(places, corners, normals, area, isFixed, cellCount)
                                   : singletonClusters(positions.size());
  CollapsingSurface surface = surfaceOf(places, corners, normals, isFixed, cells);
  if (cells.count < positions.size())
    for (CollapsingSurface::Vertex& vertex : surface.vertices)
      if (!vertex.isFixed)
        vertex.place = vertex.quadric.minimizerNear(vertex.place);
  collapseEdges(surface, triangleCount);
  SimplifiedTriangles result = resultOf(surface, frame, positions, cells);
  result.areaBefore = frame.latticeArea(area);
  return result;
}

} // namespace imgeo
