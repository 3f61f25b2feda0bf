#include "containers/compact/conquest.h"
#include "containers/compact/edge_table.h"
#include "containers/compact/lines.h"

namespace imgeo::compact {

namespace {

/// Finds the triangle of the source across each edge of the boundary.
class TriangleGuide {
public:
  TriangleGuide(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount, std::uint32_t firstTriangle,
                std::vector<std::uint32_t>& sourceCorner)
      : vertices_(vertices), edges_(vertices, vertexCount), numbers_(vertexCount, none),
        latestNodes_(vertexCount, none), nextRoot_(firstTriangle), sourceCorner_(sourceCorner) {
    sources_.reserve(vertexCount);
    sourceCorner_.clear();
    sourceCorner_.reserve(vertices.size());
  }

  void beginRoot() {
    if (edges_.isTaken(nextRoot_))
      for (nextRoot_ = lowestRoot_; edges_.isTaken(nextRoot_);)
        lowestRoot_ = ++nextRoot_;
    take(3 * nextRoot_);
  }
  std::uint32_t rootVertex(std::uint32_t i) const { return numbers_[vertices_[3 * nextRoot_ + i]]; }
  void numberRootVertex(std::uint32_t i, std::uint32_t number) { giveNumber(vertices_[3 * nextRoot_ + i], number); }

  void addNode(std::uint32_t node, std::uint32_t vertex) {
    assert(node == olderNodes_.size());
    olderNodes_.push_back(latestNodes_[vertex]);
    latestNodes_[vertex] = node;
  }

  /// Prefetches the triangles around a vertex.
  void expect(std::uint32_t vertex) const { edges_.prefetch(sources_[vertex]); }

  Step stepAcross(const Gate& gate, const std::vector<Node>& nodes) {
    const EdgeTable::Edge* const edge = edges_.find(sources_[nodes[gate.k].vertex], sources_[nodes[gate.p].vertex]);
    if (!edge)
      return Step::hole;
    take(edge->corner);
    targetSource_ = edge->third;
    targetVertex_ = numbers_[targetSource_];
    if (targetVertex_ == none)
      return Step::make;
    if (gate.next != none && nodes[gate.next].vertex == targetVertex_)
      return Step::close;
    if (gate.behind != none && nodes[gate.behind].vertex == targetVertex_)
      return Step::back;
    targetNode_ = findNode(gate, nodes);
    return targetNode_ == none ? Step::reuse : Step::join;
  }
  void numberTarget(std::uint32_t number) { giveNumber(targetSource_, number); }
  std::uint32_t targetVertex() const { return targetVertex_; }
  std::uint32_t targetNode() const { return targetNode_; }

private:
  void giveNumber(std::uint32_t source, std::uint32_t number) {
    assert(number == sources_.size());
    numbers_[source] = number;
    sources_.push_back(source);
  }

  /// Takes the triangle of a corner, which becomes its first corner.
  void take(std::uint32_t corner) {
    edges_.take(corner / 3);
    sourceCorner_.insert(sourceCorner_.end(), {corner, after(corner), before(corner)});
  }

  /// A live node of the target vertex after the pivot. Only the latest nodes of a vertex are searched, so that time
  /// stays linear; every choice is valid.
  std::uint32_t findNode(const Gate& gate, const std::vector<Node>& nodes) const {
    std::uint32_t node = latestNodes_[targetVertex_];
    for (int tries = 16; tries > 0 && node != none && node > gate.k; --tries, node = olderNodes_[node])
      if (nodes[node].isAlive() && node != gate.p)
        return node;
    return none;
  }

  std::span<const std::uint32_t> vertices_;
  EdgeTable edges_;
  std::vector<std::uint32_t> numbers_;                  ///< source vertex -> number
  std::vector<std::uint32_t> sources_;                  ///< number -> source vertex
  std::vector<std::uint32_t> latestNodes_, olderNodes_; ///< linked lists of nodes, one for each vertex
  std::uint32_t nextRoot_, lowestRoot_ = 0;
  std::uint32_t targetSource_ = none, targetVertex_ = none, targetNode_ = none;
  std::vector<std::uint32_t>& sourceCorner_;
};

/// Numbers the vertices of lines in the order of their first use.
class LineGuide {
public:
  LineGuide(std::span<const std::uint32_t> vertices, std::uint32_t vertexCount)
      : vertices_(vertices), numbers_(vertexCount, none) {}

  bool isChained(std::uint32_t line) const {
    return vertices_[std::size_t{2} * line] == vertices_[std::size_t{2} * line - 1];
  }
  std::uint32_t number(std::uint32_t corner) const { return numbers_[vertices_[corner]]; }
  void giveNumber(std::uint32_t corner, std::uint32_t number) { numbers_[vertices_[corner]] = number; }

private:
  std::span<const std::uint32_t> vertices_;
  std::vector<std::uint32_t> numbers_;
};

} // namespace

Connectivity encodeTriangles(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount,
                             std::uint32_t firstTriangle, std::vector<std::uint32_t>& sourceCorner) {
  TriangleGuide guide(vertices, vertexCount, firstTriangle, sourceCorner);
  return Conquest(encoder, guide, static_cast<std::uint32_t>(vertices.size() / 3), vertexCount).run();
}

Connectivity encodeLines(RangeEncoder& encoder, std::span<const std::uint32_t> vertices, std::uint32_t vertexCount) {
  LineGuide guide(vertices, vertexCount);
  return codeLines(encoder, guide, static_cast<std::uint32_t>(vertices.size() / 2), vertexCount);
}

} // namespace imgeo::compact
