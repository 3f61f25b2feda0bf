#pragma once
// The triangles at a directed edge that have not been taken yet: nearly at once where
// vertices have a few, and in logarithmic time however many share a vertex or an edge.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace imgeo::compact {

class EdgeTable {
public:
  /// From a vertex to another, along a triangle that has `third` besides.
  struct Edge {
    std::uint32_t to, third;
    std::uint32_t corner; ///< of the triangle, at the edge's begin
  };

  /// `vertices`, below `vertexCount`, are corners of triangles. Triangles with two equal
  /// corners have no edges here.
  EdgeTable(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount)
      : begins_(vertexCount + 2), taken_(vertices.size() / 3) {
    // Two places behind its vertex a sum of counts is where the next one's edges begin;
    // filling moves it on to where they end.
    visitEdges(vertices, [&](std::uint32_t from, const Edge&) { ++begins_[from + 2]; });
    for (std::size_t vertex = 2; vertex < begins_.size(); ++vertex)
      begins_[vertex] += begins_[vertex - 1];
    edges_.resize(begins_.back());
    visitEdges(vertices, [&](std::uint32_t from, const Edge& edge) { edges_[begins_[from + 1]++] = edge; });
    for (std::uint32_t from = 0; from < vertexCount; ++from)
      if (begins_[from + 1] - begins_[from] > fewEdges)
        std::sort(edges_.begin() + begins_[from], edges_.begin() + begins_[from + 1], before);
  }

  /// The first edge from -> to, in the source's order, whose triangle is not taken yet; or null.
  const Edge* find(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t begin = begins_[from], end = begins_[from + 1];
    if (end - begin > fewEdges)
      return findAmongMany(begin, end, to);
    // All are looked at: which one it is nobody can predict, and a wrong guess costs more.
    std::uint32_t found = end;
    for (std::uint32_t at = end; at-- > begin;)
      found = edges_[at].to == to ? at : found;
    while (found != end && (edges_[found].to != to || isTaken(edges_[found].corner / 3)))
      ++found;
    return found != end ? &edges_[found] : nullptr;
  }

  /// Begins to fetch the edges of a vertex.
  void prefetch(std::uint32_t from) const {
    const Edge* const row = edges_.data() + begins_[from];
    __builtin_prefetch(row);
    __builtin_prefetch(row + 6); // where those of most vertices end
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

  /// Those of one edge in the source's order.
  static bool before(const Edge& a, const Edge& b) { return a.to != b.to ? a.to < b.to : a.corner < b.corner; }

  /// In a sorted range. Of several triangles at one edge those found to be taken are
  /// passed over once.
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

  std::vector<Edge> edges_;           ///< by the vertex that they begin at
  std::vector<std::uint32_t> begins_; ///< by vertex: of its edges; and their end
  std::vector<std::uint32_t> passed_; ///< by the first of equal edges: how many are taken for certain
  std::vector<bool> taken_;
};

} // namespace imgeo::compact
