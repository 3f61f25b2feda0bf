#include "prepare/fan_order.h"

#include "prepare/incidence.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace imgeo {

namespace {

/// An edge of a vertex's link: the edge from -> to of a triangle, opposite the vertex.
struct LinkEdge {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t corner = 0; ///< the vertex's own corner of the triangle
  std::uint32_t from = 0, to = 0;
  std::uint32_t nextFrom = none; ///< linked list of the edges that begin at `from`
  bool isUsed = false;
};

/// A candidate for the first edge of a path along the link. Candidates are sorted by descending key, then by edge.
struct Start {
  std::uint64_t key;
  std::uint32_t edge;

  bool operator<(const Start& other) const { return key != other.key ? key > other.key : edge < other.edge; }
};

class FanWalk {
public:
  FanWalk(std::span<const std::uint32_t> cornerVertices, std::size_t vertexCount)
      : vertexOf_(cornerVertices), incidence_(incidenceOf(cornerVertices.size(), vertexCount,
                                                          [&](std::size_t corner) { return cornerVertices[corner]; })),
        isEmitted_(cornerVertices.size() / 3), discoveryIndices_(vertexCount, none), firstFrom_(vertexCount, none),
        isLinkEnd_(vertexCount) {
    queue_.reserve(vertexCount);
    result_.reserve(cornerVertices.size());
  }

  std::vector<std::uint32_t> run() && {
    std::size_t processed = 0;
    for (std::uint32_t seed = 0; seed < discoveryIndices_.size(); ++seed) {
      if (discoveryIndices_[seed] == none)
        discover(seed);
      while (processed < queue_.size())
        processVertex(queue_[processed++]);
    }
    return std::move(result_);
  }

private:
  static constexpr std::uint32_t none = LinkEdge::none;

  void discover(std::uint32_t vertex) {
    if (discoveryIndices_[vertex] != none)
      return;
    discoveryIndices_[vertex] = static_cast<std::uint32_t>(queue_.size());
    queue_.push_back(vertex);
  }

  void processVertex(std::uint32_t vertex) {
    collectLink(vertex);
    orderStarts();
    for (const Start& start : starts_)
      for (std::uint32_t edge = start.edge; edge != none; edge = followingEdge(edge)) {
        if (link_[edge].isUsed)
          break;
        emit(link_[edge]);
      }
    for (const LinkEdge& edge : link_) {
      firstFrom_[edge.from] = none;
      isLinkEnd_[edge.to] = false;
    }
  }

  void collectLink(std::uint32_t vertex) {
    link_.clear();
    for (const std::uint32_t corner : incidence_.of(vertex)) {
      const std::uint32_t triangle = corner / 3;
      if (isEmitted_[triangle])
        continue;
      isEmitted_[triangle] = true;
      const std::uint32_t first = 3 * triangle;
      LinkEdge edge;
      edge.corner = corner;
      edge.from = vertexOf_[first + (corner + 1) % 3];
      edge.to = vertexOf_[first + (corner + 2) % 3];
      link_.push_back(edge);
    }
    // Linked from the back, so that each list has the order of the input.
    for (std::size_t i = link_.size(); i-- > 0;) {
      link_[i].nextFrom = firstFrom_[link_[i].from];
      firstFrom_[link_[i].from] = static_cast<std::uint32_t>(i);
      isLinkEnd_[link_[i].to] = true;
    }
  }

  /// Paths begin at open ends of the link first, then anywhere (closed links). Among these, edges at recently
  /// discovered vertices come first, so that their indices are repeated soon.
  void orderStarts() {
    starts_.clear();
    for (std::uint32_t edge = 0; edge < link_.size(); ++edge) {
      const std::uint32_t vertex = link_[edge].from;
      const std::uint64_t recency =
          discoveryIndices_[vertex] == none ? 0 : std::uint64_t{discoveryIndices_[vertex]} + 1;
      starts_.push_back({std::uint64_t{!isLinkEnd_[vertex]} << 33 | recency, edge});
    }
    std::sort(starts_.begin(), starts_.end());
  }

  std::uint32_t followingEdge(std::uint32_t edge) {
    std::uint32_t& next = firstFrom_[link_[edge].to];
    while (next != none && link_[next].isUsed)
      next = link_[next].nextFrom;
    return next;
  }

  void emit(LinkEdge& edge) {
    edge.isUsed = true;
    discover(edge.from);
    discover(edge.to);
    const std::uint32_t first = edge.corner - edge.corner % 3;
    result_.push_back(edge.corner);
    result_.push_back(first + (edge.corner + 1) % 3);
    result_.push_back(first + (edge.corner + 2) % 3);
  }

  std::span<const std::uint32_t> vertexOf_;
  Incidence incidence_;
  std::vector<bool> isEmitted_;                 ///< by triangle
  std::vector<std::uint32_t> discoveryIndices_; ///< by vertex; none: not discovered
  std::vector<std::uint32_t> queue_;            ///< vertices by discovery index
  std::vector<std::uint32_t> firstFrom_;        ///< by vertex: its first link edge; none outside of processVertex
  std::vector<bool> isLinkEnd_;                 ///< by vertex: a link edge ends there; false outside of processVertex
  std::vector<LinkEdge> link_;
  std::vector<Start> starts_;
  std::vector<std::uint32_t> result_;
};

} // namespace

std::vector<std::uint32_t> fanOrder(std::span<const std::uint32_t> cornerVertices, std::size_t vertexCount) {
  assert(cornerVertices.size() % 3 == 0);
  return FanWalk(cornerVertices, vertexCount).run();
}

} // namespace imgeo
