#pragma once
// Triangles grow from a boundary: the cut-border machine of Gumhold and Straßer, "Real time compression of triangle
// mesh connectivity", 1998, with vertices processed in the order of their discovery, and the degrees of Touma and
// Gotsman, "Triangle mesh compression", 1998, as contexts. The same loop encodes and decodes: docs/formats/compact.md,
// "Connectivity of triangles".

#include "containers/compact/connectivity.h"
#include "containers/compact/symbols.h"

#include <algorithm>
#include <array>

namespace imgeo::compact {

/// The triangle across an edge of the boundary, by its third vertex.
enum class Step : std::uint8_t {
  make,  ///< a new vertex
  close, ///< the vertex of the next node
  back,  ///< the vertex of the node before the edge
  hole,  ///< there is no triangle
  join,  ///< the vertex of a later node
  reuse, ///< any other known vertex
};

/// The first model of each symbol in the stream.
namespace conquestModels {
inline constexpr std::size_t degreeContexts = std::size_t{12} * 12 * 8;
inline constexpr std::size_t make = 0, close = make + degreeContexts, back = close + degreeContexts,
                             hole = back + degreeContexts, join = hole + 4, old = join + 1, node = old + 3,
                             vertex = node + numberModels, count = vertex + numberModels;
} // namespace conquestModels

/// A node of the boundary, which consists of loops and open chains. Its edge runs from the previous node to it.
struct Node {
  std::uint32_t vertex = 0;
  std::uint32_t previous = none, next = none;
  std::uint32_t apex = none; ///< the corner opposite its edge, in the triangle that has been coded

  bool isAlive() const { return previous != none || next != none; }
};

/// The nodes around the edge p -> k that is crossed.
struct Gate {
  std::uint32_t k, p, next, behind; ///< `next` after k, `behind` before p; `none` at a chain's end
};

/// `Guide` knows the triangles of an encoder: see TriangleGuide in encode_connectivity.cpp. Decoders do not use it.
template <typename Coder, typename Guide> class Conquest {
public:
  Conquest(Coder& coder, Guide& guide, std::uint32_t triangleCount, std::uint32_t vertexCount)
      : coder_(coder), guide_(guide), triangleCount_(triangleCount), vertexCount_(vertexCount) {
    out_.vertex.reserve(std::size_t{triangleCount} * 3);
    out_.across.reserve(triangleCount);
    out_.closing.reserve(triangleCount);
    for (std::vector<std::uint32_t>* perVertex : {&out_.ahead, &out_.behind, &out_.second})
      perVertex->assign(vertexCount, none);
    degrees_.assign(vertexCount, 0);
    nodes_.reserve(vertexCount + vertexCount / 4);
    if constexpr (!Coder::encodes)
      out_.fans.reserve(2 * nodes_.capacity());
  }

  Connectivity run() {
    std::uint32_t pivot = 0;
    while (!isComplete()) {
      codeRoot();
      for (; pivot < nodes_.size(); ++pivot) {
        if constexpr (Coder::encodes)
          if (pivot + lookahead < nodes_.size())
            guide_.expect(vertexOf(pivot + lookahead));
        while (!isComplete() && nodes_[pivot].previous != none)
          crossEdgeTo(pivot);
        if constexpr (!Coder::encodes) {
          out_.fans.push_back(static_cast<std::uint32_t>(out_.across.size()));
          out_.fans.push_back(static_cast<std::uint32_t>(nodes_.size()));
        }
      }
    }
    coder_.require(out_.vertexCount == vertexCount_, "there are fewer vertices than the header states");
    return std::move(out_);
  }

private:
  static constexpr std::uint32_t lookahead = 4;

  bool isComplete() const { return out_.across.size() == triangleCount_; }
  std::uint32_t vertexOf(std::uint32_t node) const { return nodes_[node].vertex; }
  std::uint32_t firstCorner() const { return static_cast<std::uint32_t>(out_.vertex.size() - 3); }

  std::uint32_t makeVertex() {
    coder_.require(out_.vertexCount < vertexCount_, "there are more vertices than the header states");
    return out_.vertexCount++;
  }

  /// Codes a vertex that is known already; `vertex` is its number.
  std::uint32_t codeOld(std::uint32_t vertex) {
    const std::uint32_t distance = codeNumber(coder_, conquestModels::vertex, out_.vertexCount - 1 - vertex);
    coder_.require(distance < out_.vertexCount, "a vertex is named that has not come");
    return out_.vertexCount - 1 - distance;
  }

  std::uint32_t addNode(const Node& node) {
    nodes_.push_back(node);
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  void addTriangle(std::array<std::uint32_t, 3> vertices, std::uint32_t across, std::uint32_t closing) {
    for (const std::uint32_t vertex : vertices) {
      out_.vertex.push_back(vertex);
      ++degrees_[vertex];
    }
    out_.across.push_back(across);
    out_.closing.push_back(closing);
  }

  /// A triangle that shares no edge with the boundary.
  void codeRoot() {
    if constexpr (Coder::encodes)
      guide_.beginRoot();
    std::array<std::uint32_t, 3> vertices{};
    for (std::uint32_t i = 0; i < 3; ++i) {
      std::uint32_t known = none;
      if constexpr (Coder::encodes)
        known = guide_.rootVertex(i);
      if (coder_.bit(conquestModels::old + i, known != none)) {
        vertices[i] = codeOld(known);
      } else {
        vertices[i] = makeVertex();
        if constexpr (Coder::encodes)
          guide_.numberRootVertex(i, vertices[i]);
      }
    }
    addTriangle(vertices, none, none);
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t node =
          addNode({vertices[i], first + (i + 2) % 3, first + (i + 1) % 3, firstCorner() + (i + 1) % 3});
      if constexpr (Coder::encodes)
        guide_.addNode(node, vertices[i]);
    }
  }

  std::size_t contextOf(const Gate& gate) const {
    const std::uint32_t k = std::min(degrees_[vertexOf(gate.k)], 11u);
    const std::uint32_t p = std::min(degrees_[vertexOf(gate.p)], 11u);
    const std::uint32_t n = gate.next == none ? 0 : std::min(degrees_[vertexOf(gate.next)], 7u);
    return (k * 12 + p) * 8 + n;
  }

  Step codeStep(const Gate& gate, Step step) {
    namespace models = conquestModels;
    const std::size_t context = contextOf(gate);
    if (coder_.bit(models::make + context, step == Step::make))
      return Step::make;
    if (gate.next != none && coder_.bit(models::close + context, step == Step::close))
      return Step::close;
    if (gate.behind != none && coder_.bit(models::back + context, step == Step::back))
      return Step::back;
    const std::size_t ends = std::size_t{gate.next == none} + 2 * std::size_t{gate.behind == none};
    if (coder_.bit(models::hole + ends, step == Step::hole))
      return Step::hole;
    return coder_.bit(models::join, step == Step::join) ? Step::join : Step::reuse;
  }

  void crossEdgeTo(std::uint32_t k) {
    const std::uint32_t p = nodes_[k].previous;
    const Gate gate{k, p, nodes_[k].next, nodes_[p].previous};
    Step step{};
    if constexpr (Coder::encodes)
      step = guide_.stepAcross(gate, nodes_);
    switch (codeStep(gate, step)) {
    case Step::make:
      make(gate);
      break;
    case Step::close:
      close(gate);
      break;
    case Step::back:
      back(gate);
      break;
    case Step::hole:
      nodes_[k].previous = none;
      nodes_[p].next = none;
      break;
    case Step::join:
      join(gate);
      break;
    case Step::reuse: {
      std::uint32_t known = 0;
      if constexpr (Coder::encodes)
        known = guide_.targetVertex();
      insert(gate, codeOld(known));
      break;
    }
    }
  }

  void make(const Gate& gate) {
    const std::uint32_t vertex = makeVertex();
    if constexpr (Coder::encodes)
      guide_.numberTarget(vertex);
    out_.ahead[vertex] = gate.next == none ? none : vertexOf(gate.next);
    out_.behind[vertex] = gate.behind == none ? none : vertexOf(gate.behind);
    insert(gate, vertex);
  }

  /// A triangle whose third vertex becomes a new node between p and k.
  void insert(const Gate& gate, std::uint32_t vertex) {
    addTriangle({vertexOf(gate.k), vertexOf(gate.p), vertex}, nodes_[gate.k].apex, none);
    const std::uint32_t node = addNode({vertex, gate.p, gate.k, firstCorner()});
    if constexpr (Coder::encodes)
      guide_.addNode(node, vertex);
    nodes_[gate.p].next = node;
    nodes_[gate.k].previous = node;
    nodes_[gate.k].apex = firstCorner() + 1;
  }

  /// A triangle with the next node's vertex: k is done.
  void close(const Gate& gate) {
    const auto [k, p, next, behind] = gate;
    const std::uint32_t closing = nodes_[next].apex, vertex = vertexOf(p);
    if (vertex > vertexOf(k) && vertex > vertexOf(next) && vertex > out_.vertex[closing] && out_.second[vertex] == none)
      out_.second[vertex] = closing;
    addTriangle({vertexOf(k), vertex, vertexOf(next)}, nodes_[k].apex, closing);
    nodes_[k].previous = nodes_[k].next = none;
    if (behind == next) { // the loop is closed
      nodes_[p].previous = nodes_[p].next = nodes_[next].previous = nodes_[next].next = none;
      return;
    }
    nodes_[p].next = next;
    nodes_[next].previous = p;
    nodes_[next].apex = firstCorner();
  }

  /// A triangle with the vertex before p: p is done.
  void back(const Gate& gate) {
    const auto [k, p, next, behind] = gate;
    addTriangle({vertexOf(k), vertexOf(p), vertexOf(behind)}, nodes_[k].apex, nodes_[p].apex);
    nodes_[p].previous = nodes_[p].next = none;
    nodes_[behind].next = k;
    nodes_[k].previous = behind;
    nodes_[k].apex = firstCorner() + 1;
  }

  /// A triangle with the vertex of a later node: its loop splits, or two loops become one. The node keeps what follows
  /// it; a new node of the same vertex takes over what came before.
  void join(const Gate& gate) {
    const auto [k, p, next, behind] = gate;
    std::uint32_t target = k + 1;
    if constexpr (Coder::encodes)
      target = guide_.targetNode();
    target = k + 1 + codeNumber(coder_, conquestModels::node, target - k - 1);
    coder_.require(target < nodes_.size(), "a boundary node is named that has not come");
    addTriangle({vertexOf(k), vertexOf(p), vertexOf(target)}, nodes_[k].apex, none);
    const std::uint32_t beforeTarget = nodes_[target].previous;
    const std::uint32_t node = addNode({vertexOf(target), beforeTarget, k, nodes_[target].apex});
    if constexpr (Coder::encodes)
      guide_.addNode(node, vertexOf(target));
    if (beforeTarget != none)
      nodes_[beforeTarget].next = node;
    nodes_[target].previous = p;
    nodes_[target].apex = firstCorner();
    nodes_[p].next = target;
    nodes_[k].previous = node;
    nodes_[k].apex = firstCorner() + 1;
  }

  Coder& coder_;
  Guide& guide_;
  std::uint32_t triangleCount_, vertexCount_;
  Connectivity out_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> degrees_;
};

} // namespace imgeo::compact
