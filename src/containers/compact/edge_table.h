#pragma once
// The triangles at a directed edge that have not been taken yet: nearly at once where
// vertices have a few, and in logarithmic time however many share a vertex or an edge.

#include "prepare/incidence.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

class EdgeTable {
public:
  static constexpr std::uint32_t none = UINT32_MAX;

  /// `vertices`, below `vertexCount`, are corners of triangles. Triangles with two equal
  /// corners have no edges here.
  EdgeTable(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount)
      : taken_(vertices.size() / 3) {
    const Incidence incidence =
        incidenceOf(vertices.size(), vertexCount, [&](std::size_t corner) { return vertices[corner]; });
    edges_.reserve(vertices.size());
    begins_.reserve(vertexCount + 1);
    for (std::uint32_t from = 0; from < vertexCount; ++from) {
      begins_.push_back(static_cast<std::uint32_t>(edges_.size()));
      for (const std::uint32_t corner : incidence.of(from)) {
        const std::uint32_t first = corner - corner % 3;
        const std::uint32_t to = vertices[first + (corner + 1) % 3],
                            third = vertices[first + (corner + 2) % 3];
        if (from != to && to != third && third != from)
          edges_.push_back({to, corner});
      }
      std::sort(edges_.begin() + begins_.back(), edges_.end(), before);
    }
    begins_.push_back(static_cast<std::uint32_t>(edges_.size()));
  }

  /// The corner at `from` of a triangle, not taken yet, that has the edge from -> to; or none.
  std::uint32_t find(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t end = begins_[from + 1];
    std::uint32_t at = begins_[from];
    if (end - at > fewEdges)
      at = static_cast<std::uint32_t>(
          std::lower_bound(edges_.begin() + at, edges_.begin() + end, Edge{to, 0}, before) - edges_.begin());
    else
      while (at != end && edges_[at].to < to)
        ++at;
    if (at == end || edges_[at].to != to)
      return none;
    if (!isTaken(edges_[at].corner / 3))
      return edges_[at].corner;
    return findBehind(at, end, to);
  }

  bool isTaken(std::uint32_t triangle) const { return taken_[triangle]; }
  void take(std::uint32_t triangle) { taken_[triangle] = true; }

private:
  struct Edge {
    std::uint32_t to, corner;
  };
  static constexpr std::uint32_t fewEdges = 16;

  /// Those of one edge in the source's order.
  static bool before(const Edge& a, const Edge& b) {
    return a.to != b.to ? a.to < b.to : a.corner < b.corner;
  }

  /// Of several triangles at one edge: those found to be taken are passed over once.
  std::uint32_t findBehind(std::uint32_t first, std::uint32_t end, std::uint32_t to) {
    if (passed_.empty())
      passed_.resize(edges_.size());
    std::uint32_t at = first + passed_[first];
    while (at != end && edges_[at].to == to && isTaken(edges_[at].corner / 3))
      ++at;
    passed_[first] = at - first;
    return at != end && edges_[at].to == to ? edges_[at].corner : none;
  }

  std::vector<Edge> edges_;           ///< by the vertex that they begin at, then by that they lead to
  std::vector<std::uint32_t> begins_; ///< by vertex: of its edges; and their end
  std::vector<std::uint32_t> passed_; ///< by the first of equal edges: how many are taken for certain
  std::vector<bool> taken_;
};

} // namespace imgeo::compact
