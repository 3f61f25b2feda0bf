#pragma once
// Finds, at a directed edge, a triangle that has not been taken: in constant time if vertices have few triangles, in
// logarithmic time if many triangles share a vertex or an edge.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

class EdgeTable {
public:
  /// A directed edge of a triangle whose third vertex is `third`.
  struct Edge {
    std::uint32_t to, third;
    std::uint32_t corner; ///< of the triangle, at the start of the edge
  };

  /// `vertices` are the corners of triangles, below `vertexCount`. Triangles with two equal corners are left out.
  EdgeTable(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount)
      : begins_(vertexCount + 2), taken_(vertices.size() / 3) {
    // Counts go to index vertex + 2. After summing, begins_[vertex + 1] is where the edges of the vertex begin; filling
    // moves it to their end.
    visitEdges(vertices, [&](std::uint32_t from, const Edge&) { ++begins_[from + 2]; });
    for (std::size_t vertex = 2; vertex < begins_.size(); ++vertex)
      begins_[vertex] += begins_[vertex - 1];
    edges_.resize(begins_.back());
    visitEdges(vertices, [&](std::uint32_t from, const Edge& edge) { edges_[begins_[from + 1]++] = edge; });
    for (std::uint32_t from = 0; from < vertexCount; ++from)
      if (begins_[from + 1] - begins_[from] > fewEdges)
        std::sort(edges_.begin() + begins_[from], edges_.begin() + begins_[from + 1], before);
  }

  /// The first edge from -> to, in the source's order, whose triangle is not taken; nullptr: none.
  const Edge* find(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t begin = begins_[from], end = begins_[from + 1];
    if (end - begin > fewEdges)
      return findAmongMany(begin, end, to);
    // The loop visits all: an early exit would be a mispredicted branch, which costs more.
    std::uint32_t found = end;
    for (std::uint32_t at = end; at-- > begin;)
      found = edges_[at].to == to ? at : found;
    while (found != end && (edges_[found].to != to || isTaken(edges_[found].corner / 3)))
      ++found;
    return found != end ? &edges_[found] : nullptr;
  }

  /// Prefetches the edges of a vertex.
  void prefetch(std::uint32_t from) const {
    const Edge* const row = edges_.data() + begins_[from];
    __builtin_prefetch(row);
    __builtin_prefetch(row + 6); // the edges of most vertices end there
  }

  bool isTaken(std::uint32_t triangle) const { return taken_[triangle]; }
  void take(std::uint32_t triangle) { taken_[triangle] = true; }

private:
  static constexpr std::uint32_t fewEdges = 16;

  template <typename Visit> static void visitEdges(std::span<const std::uint32_t> vertices, const Visit& visit) {
    for (std::uint32_t corner = 0; corner < vertices.size(); corner += 3) {
      const std::uint32_t a = vertices[corner], b = vertices[corner + 1], c = vertices[corner + 2];
      if (a == b || b == c || c == a)
        continue;
      visit(a, {b, c, corner});
      visit(b, {c, a, corner + 1});
      visit(c, {a, b, corner + 2});
    }
  }

  /// Sorts edges of one vertex by their end, edges with the same end in the source's order.
  static bool before(const Edge& a, const Edge& b) { return a.to != b.to ? a.to < b.to : a.corner < b.corner; }

  /// Searches a sorted range. Taken triangles of one edge are skipped only once.
  const Edge* findAmongMany(std::uint32_t begin, std::uint32_t end, std::uint32_t to) {
    if (passed_.empty())
      passed_.resize(edges_.size());
    const auto first = static_cast<std::uint32_t>(
        std::lower_bound(edges_.begin() + begin, edges_.begin() + end, Edge{to, 0, 0}, before) - edges_.begin());
    if (first == end || edges_[first].to != to)
      return nullptr;
    std::uint32_t at = first + passed_[first];
    while (at != end && edges_[at].to == to && isTaken(edges_[at].corner / 3))
      ++at;
    passed_[first] = at - first;
    return at != end && edges_[at].to == to ? &edges_[at] : nullptr;
  }

  std::vector<Edge> edges_;           ///< sorted by their first vertex
  std::vector<std::uint32_t> begins_; ///< per vertex: the begin of its edges; one more for the end
  std::vector<std::uint32_t> passed_; ///< per first of equal edges: number of leading edges known to be taken
  std::vector<bool> taken_;
};

} // namespace imgeo::compact
