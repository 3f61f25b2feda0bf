#include "prepare/edge_collapse.h"

#include "prepare/d_ary_heap.h"
#include "prepare/triangle_tree.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace imgeo {

namespace {

/// An edge in the queue with its cost. An entry whose `versions` is no longer the sum of its vertices' versions
/// is outdated.
struct Candidate {
  std::uint64_t rank = 0; ///< upper half: the bits of its cost, a float of 0 or more; lower half: `from`
  std::uint32_t to = 0, versions = 0;

  Candidate(float cost, std::uint32_t from, std::uint32_t other, std::uint32_t sum)
      : rank(std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32 | from), to(other), versions(sum) {}
  std::uint32_t from() const { return static_cast<std::uint32_t>(rank); }
  float cost() const { return std::bit_cast<float>(static_cast<std::uint32_t>(rank >> 32)); }

  /// Orders by cost, then by vertices. Has no branches, which would be unpredictable.
  bool isBefore(const Candidate& other) const { return (rank < other.rank) | ((rank == other.rank) & (to < other.to)); }
};

struct Edge {
  std::uint32_t a, b;
  std::uint32_t triangleCount;
};

class EdgeCollapse {
public:
  EdgeCollapse(CollapsingSurface& surface, std::size_t triangleCount, CollapseOrder order)
      : vertices_(surface.vertices), corners_(surface.corners), sources_(surface.sources), order_(order),
        targetCount_(triangleCount), triangleCount_(corners_.size() / 3), first_(vertices_.size(), none),
        last_(vertices_.size(), none), next_(corners_.size(), none), isRemoved_(triangleCount_),
        isBorder_(vertices_.size()), versions_(vertices_.size()), marks_(vertices_.size()) {
    for (std::uint32_t corner = 0; corner < corners_.size(); ++corner)
      append(corners_[corner], corner, corner);
  }

  void run() {
    const std::vector<Edge> edges = allEdges();
    for (const Edge& edge : edges)
      if (edge.triangleCount == 1)
        addBorderPlane(edge);
    for (const CollapsingSurface::Vertex& vertex : vertices_)
      totalWeight_ += vertex.quadric.weight();
    vertexCount_ = vertices_.size();
    for (const Edge& edge : edges)
      pushCandidate(edge.a, edge.b);
    while (triangleCount_ > targetCount_ && !heap_.empty()) {
      const Candidate candidate = heap_.top();
      heap_.pop();
      if (candidate.versions == versions_[candidate.from()] + versions_[candidate.to])
        collapse(candidate);
    }
    eraseRemovedTriangles();
  }

private:
  static constexpr std::uint32_t none = CollapsingSurface::none;

  static std::uint32_t afterCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static std::uint32_t beforeCorner(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

  /// Appends the linked corners `begin` to `end` to those of a vertex.
  void append(std::uint32_t vertex, std::uint32_t begin, std::uint32_t end) {
    if (first_[vertex] == none)
      first_[vertex] = begin;
    else
      next_[last_[vertex]] = begin;
    last_[vertex] = end;
  }

  /// Calls visit(corner) for each corner of a vertex whose triangle remains.
  template <typename Visit> void visitCorners(std::uint32_t vertex, Visit visit) const {
    for (std::uint32_t corner = first_[vertex]; corner != none; corner = next_[corner])
      if (!isRemoved_[corner / 3])
        visit(corner);
  }

  /// The vertices that share an edge with `vertex`. Increments mark_ and sets the marks_ of these vertices to it. The
  /// reference is valid until the next call.
  const std::vector<std::uint32_t>& neighboursOf(std::uint32_t vertex) {
    neighbours_.clear();
    ++mark_;
    visitCorners(vertex, [&](std::uint32_t corner) {
      for (const std::uint32_t other : {corners_[afterCorner(corner)], corners_[beforeCorner(corner)]})
        if (marks_[other] != mark_) {
          marks_[other] = mark_;
          neighbours_.push_back(other);
        }
    });
    return neighbours_;
  }

  /// Every edge once, with a < b.
  std::vector<Edge> allEdges() {
    std::vector<Edge> edges;
    edges.reserve(corners_.size() / 2);
    std::vector<std::size_t> edgeTo(vertices_.size()); // by higher vertex: index of its edge
    for (std::uint32_t a = 0; a < vertices_.size(); ++a) {
      const std::size_t first = edges.size();
      visitCorners(a, [&](std::uint32_t corner) {
        for (const std::uint32_t b : {corners_[afterCorner(corner)], corners_[beforeCorner(corner)]})
          if (a < b) {
            if (edgeTo[b] < first || edgeTo[b] >= edges.size() || edges[edgeTo[b]].b != b) {
              edgeTo[b] = edges.size();
              edges.push_back({a, b, 0});
            }
            ++edges[edgeTo[b]].triangleCount;
          }
      });
    }
    return edges;
  }

  /// Adds the plane through a border edge that is perpendicular to its triangle (Garland and Heckbert 1997, section 6).
  void addBorderPlane(const Edge& edge) {
    const std::uint32_t a = edge.a, b = edge.b; // clang 14: lambdas cannot capture structured bindings
    isBorder_[a] = isBorder_[b] = true;
    const Vec3d along = vertices_[b].position - vertices_[a].position;
    Vec3d normal;
    visitCorners(a, [&](std::uint32_t corner) {
      const std::uint32_t u = corners_[afterCorner(corner)], v = corners_[beforeCorner(corner)];
      if (u == b || v == b)
        normal = cross(along, vertices_[u == b ? v : u].position - vertices_[a].position);
    });
    const Vec3d across = cross(along, normal);
    const double size = length(across);
    if (!(size > 0))
      return;
    constexpr double borderWeight = 3;
    for (const std::uint32_t vertex : {a, b})
      vertices_[vertex].quadric.addPlane(across * (1 / size), vertices_[a].position, borderWeight * dot(along, along));
  }

  /// Position of the vertex that a and b are merged into.
  Vec3d mergedPosition(std::uint32_t a, std::uint32_t b, const Quadric& quadric) const {
    if (vertices_[a].isFixed)
      return vertices_[a].position;
    if (vertices_[b].isFixed)
      return vertices_[b].position;
    return quadric.minimizerNear((vertices_[a].position + vertices_[b].position) * 0.5);
  }

  void pushCandidate(std::uint32_t a, std::uint32_t b) {
    if (vertices_[a].isFixed && vertices_[b].isFixed)
      return;
    Quadric quadric = vertices_[a].quadric;
    quadric += vertices_[b].quadric;
    const Vec3d edge = vertices_[b].position - vertices_[a].position;
    // In flat regions, where the quadric error is 0, short edges are collapsed first.
    constexpr double lengthWeight = 1e-5;
    const double cost = std::max(0.0, quadric.errorAt(mergedPosition(a, b, quadric))) +
                        lengthWeight * quadric.weight() * dot(edge, edge);
    heap_.push({static_cast<float>(cost), std::min(a, b), std::max(a, b), versions_[a] + versions_[b]});
  }

  /// Whether the edge meets the link condition (Dey et al. 1999), that every common neighbour of a and b is the third
  /// corner of a triangle at their edge, and its collapse does not join two borders.
  bool keepsTopology(std::uint32_t a, std::uint32_t b) {
    neighboursOf(b);
    std::uint32_t edgeTriangleCount = 0;
    visitCorners(a, [&](std::uint32_t corner) {
      const std::uint32_t u = corners_[afterCorner(corner)], v = corners_[beforeCorner(corner)];
      if (u != b && v != b)
        return;
      ++edgeTriangleCount;
      marks_[u == b ? v : u] = 0;
    });
    bool breaksTopology = isBorder_[a] && isBorder_[b] && edgeTriangleCount != 1;
    visitCorners(a, [&](std::uint32_t corner) {
      breaksTopology = breaksTopology || marks_[corners_[afterCorner(corner)]] == mark_ ||
                       marks_[corners_[beforeCorner(corner)]] == mark_;
    });
    return !breaksTopology;
  }

  /// Whether moving `vertex` to `position` would flip, or nearly flip, a triangle that does not contain `other`.
  bool flipsTriangle(std::uint32_t vertex, std::uint32_t other, Vec3d position) const {
    bool flips = false;
    visitCorners(vertex, [&](std::uint32_t corner) {
      const std::uint32_t u = corners_[afterCorner(corner)], v = corners_[beforeCorner(corner)];
      if (flips || u == other || v == other)
        return;
      const Vec3d pu = vertices_[u].position, pv = vertices_[v].position;
      const Vec3d before = cross(pu - vertices_[vertex].position, pv - vertices_[vertex].position);
      const Vec3d after = cross(pu - position, pv - position);
      constexpr double minCosine = 0.2;
      flips = dot(before, after) < minCosine * length(before) * length(after);
    });
    return flips;
  }

  /// The larger squared distance of two neighbours from the triangles around them after merging them at `position`;
  /// infinite if none would remain.
  double squaredDistanceAfter(std::uint32_t from, std::uint32_t to, Vec3d position) const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    double ofFrom = infinite, ofTo = infinite;
    for (const std::uint32_t vertex : {from, to})
      visitCorners(vertex, [&](std::uint32_t corner) {
        const std::uint32_t u = corners_[afterCorner(corner)], v = corners_[beforeCorner(corner)];
        if (u == from || v == from || u == to || v == to)
          return;
        const Triangle triangle{position, vertices_[u].position, vertices_[v].position};
        ofFrom = std::min(ofFrom, nearestPoint(vertices_[from].position, triangle).squaredDistance);
        ofTo = std::min(ofTo, nearestPoint(vertices_[to].position, triangle).squaredDistance);
      });
    return std::max(ofFrom, ofTo);
  }

  /// With measured collapses: whether a candidate may be collapsed now. If the ends of its edge are farther from what
  /// would replace it than it was charged for, it goes back into the queue at the cost of that distance. A spike has
  /// little area; its distance weighs as much as the mean vertex.
  bool isChargedEnough(const Candidate& candidate, std::uint32_t from, std::uint32_t to, Vec3d position,
                       double weight) {
    const double squared = squaredDistanceAfter(from, to, position);
    if (squared == std::numeric_limits<double>::infinity())
      return false;
    constexpr double tolerance = 1.5;
    const double meanWeight = totalWeight_ / static_cast<double>(vertexCount_);
    const auto cost = static_cast<float>(std::max(weight, meanWeight) * squared);
    if (!(cost > tolerance * tolerance * candidate.cost()))
      return true;
    heap_.push({cost, candidate.from(), candidate.to, candidate.versions});
    return false;
  }

  /// Merges two neighbours, unless that breaks the topology or flips a triangle, or costs more than was charged.
  void collapse(const Candidate& candidate) {
    std::uint32_t from = candidate.from(), to = candidate.to;
    if (vertices_[from].isFixed)
      std::swap(from, to);
    Quadric quadric = vertices_[to].quadric;
    quadric += vertices_[from].quadric;
    const Vec3d position = mergedPosition(from, to, quadric);
    if (!keepsTopology(from, to) || flipsTriangle(from, to, position) || flipsTriangle(to, from, position))
      return;
    if (order_ == CollapseOrder::measured && !isChargedEnough(candidate, from, to, position, quadric.weight()))
      return;
    --vertexCount_;
    visitCorners(from, [&](std::uint32_t corner) {
      if (corners_[afterCorner(corner)] == to || corners_[beforeCorner(corner)] == to) {
        isRemoved_[corner / 3] = true;
        --triangleCount_;
      } else {
        corners_[corner] = to;
      }
    });
    append(to, first_[from], last_[from]);
    first_[from] = none;
    vertices_[from].mergedInto = to;
    vertices_[to].position = position;
    vertices_[to].quadric = quadric;
    isBorder_[to] = isBorder_[to] || isBorder_[from];
    ++versions_[to];
    ++versions_[from];
    for (const std::uint32_t neighbour : neighboursOf(to))
      pushCandidate(to, neighbour);
  }

  void eraseRemovedTriangles() {
    std::size_t kept = 0;
    for (std::size_t triangle = 0; triangle < isRemoved_.size(); ++triangle) {
      if (isRemoved_[triangle])
        continue;
      std::copy_n(&corners_[3 * triangle], 3, &corners_[3 * kept]);
      sources_[kept++] = sources_[triangle];
    }
    corners_.resize(3 * kept);
    sources_.resize(kept);
  }

  std::vector<CollapsingSurface::Vertex>& vertices_;
  std::vector<std::uint32_t>& corners_;
  std::vector<std::uint32_t>& sources_;
  CollapseOrder order_;
  std::size_t targetCount_, triangleCount_;
  double totalWeight_ = 0;                         ///< of all quadrics
  std::size_t vertexCount_ = 0;                    ///< of vertices that have not been merged into another
  std::vector<std::uint32_t> first_, last_, next_; ///< linked list of the corners of each vertex
  std::vector<bool> isRemoved_;                    ///< by triangle
  std::vector<bool> isBorder_;                     ///< by vertex
  std::vector<std::uint32_t> versions_;            ///< by vertex: number of its changes
  std::vector<std::uint32_t> marks_; ///< by vertex: mark_ if the vertex was found by the last neighboursOf()
  std::vector<std::uint32_t> neighbours_;
  std::uint32_t mark_ = 0;
  DaryHeap<Candidate> heap_;
};

} // namespace

void collapseEdges(CollapsingSurface& surface, std::size_t triangleCount, CollapseOrder order) {
  EdgeCollapse(surface, triangleCount, order).run();
}

} // namespace imgeo
