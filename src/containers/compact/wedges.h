#pragma once
// Encodes and decodes the wedge of each corner: docs/formats/compact.md, "Wedges". A seam is where the wedges of two
// triangles differ at their common edge.

#include "containers/compact/connectivity.h"
#include "containers/compact/symbols.h"

namespace imgeo::compact {

/// The first model of each symbol in the stream.
namespace wedgeModels {
inline constexpr std::size_t split = 0, same = split + 3, made = same + 9, step = made + 3, wedge = step + 16,
                             count = wedge + numberModels;
}

struct Wedges {
  std::vector<std::uint32_t> ofCorner; ///< corner -> wedge
  std::vector<std::uint32_t> vertex;   ///< per wedge
  std::vector<std::uint32_t> corner;   ///< per wedge: the first corner that has it
  std::vector<std::uint32_t> previous; ///< per wedge: the previous wedge of its vertex, or none

  std::uint32_t count() const { return static_cast<std::uint32_t>(vertex.size()); }
};

/// The wedges of a patch without seams: one for each vertex, not coded.
Wedges plainWedges(const Connectivity& connectivity);

/// `SourceWedge(corner)` is the wedge of a corner in the numbering of an encoder, below `wedgeCount`.
template <typename Coder, typename SourceWedge> class WedgeCoder {
public:
  WedgeCoder(Coder& coder, const Connectivity& connectivity, std::uint32_t wedgeCount, SourceWedge sourceWedge)
      : coder_(coder), connectivity_(connectivity), wedgeCount_(wedgeCount), sourceWedge_(sourceWedge),
        start_(connectivity.vertexCount, none), made_(connectivity.vertexCount, none),
        latest_(connectivity.vertexCount, none), extra_(connectivity.vertexCount, 0),
        isSplit_(connectivity.vertexCount), numbers_(Coder::encodes ? wedgeCount : 0, none) {
    out_.ofCorner.reserve(connectivity.vertex.size());
    if constexpr (Coder::encodes)
      findSplits();
  }

  Wedges run() {
    const std::size_t perElement = connectivity_.across.empty() ? 2 : 3;
    std::uint32_t differing = 0, splits = 0;
    for (std::uint32_t corner = 0; corner < connectivity_.vertex.size(); ++corner) {
      if (corner % perElement == 0)
        differing = splits = 0;
      const std::uint32_t vertex = connectivity_.vertex[corner];
      std::uint32_t wedge = start_[vertex];
      if (wedge == none) {
        wedge = make(corner);
        isSplit_[vertex] = coder_.bit(wedgeModels::split + splits, isSplit_[vertex]);
      } else if (!isSplit_[vertex]) {
        // All corners of the vertex have the same wedge.
      } else if (const std::uint32_t guess = guessAt(corner); codeIsSame(corner, guess, differing)) {
        wedge = guess;
      } else {
        ++differing;
        wedge = codeOther(corner, guess);
      }
      out_.ofCorner.push_back(wedge);
      latest_[vertex] = wedge;
      splits += isSplit_[vertex];
    }
    coder_.require(out_.count() == wedgeCount_, "there are fewer wedges than the header states");
    return std::move(out_);
  }

private:
  /// Finds the vertices with several wedges, for encoders.
  void findSplits() {
    std::vector<std::uint32_t> firsts(connectivity_.vertexCount, none);
    for (std::uint32_t corner = 0; corner < connectivity_.vertex.size(); ++corner) {
      const std::uint32_t vertex = connectivity_.vertex[corner], wedge = sourceWedge_(corner);
      if (firsts[vertex] == none)
        firsts[vertex] = wedge;
      else if (firsts[vertex] != wedge)
        isSplit_[vertex] = true;
    }
  }

  /// The wedge of the vertex in the earlier triangle across an edge; without one, the latest wedge of the vertex.
  std::uint32_t guessAt(std::uint32_t corner) const {
    const std::uint32_t vertex = connectivity_.vertex[corner];
    if (connectivity_.across.empty())
      return latest_[vertex];
    const std::uint32_t across = connectivity_.across[corner / 3], closing = connectivity_.closing[corner / 3];
    if (corner % 3 == 2) {
      if (closing == none)
        return latest_[vertex];
      const bool isAfter = connectivity_.vertex[after(closing)] == vertex;
      return out_.ofCorner[isAfter ? after(closing) : before(closing)];
    }
    return across == none ? latest_[vertex] : out_.ofCorner[corner % 3 == 0 ? before(across) : after(across)];
  }

  /// For encoders: the coded number of the wedge of a corner; none: not coded yet.
  std::uint32_t sourceNumber(std::uint32_t corner) const {
    if constexpr (Coder::encodes)
      return numbers_[sourceWedge_(corner)];
    return none;
  }

  bool codeIsSame(std::uint32_t corner, std::uint32_t guess, std::uint32_t differing) {
    const std::uint32_t extra = std::min(extra_[connectivity_.vertex[corner]], 2u);
    return coder_.bit(wedgeModels::same + std::size_t{extra} * 3 + differing, sourceNumber(corner) == guess);
  }

  std::uint32_t codeOther(std::uint32_t corner, std::uint32_t guess) {
    const std::uint32_t vertex = connectivity_.vertex[corner], source = sourceNumber(corner);
    if (coder_.bit(wedgeModels::made + std::min(extra_[vertex], 2u), source == none))
      return make(corner);
    coder_.require(extra_[vertex] > 0, "a vertex of one wedge has another");
    std::uint32_t steps = 0;
    if (extra_[vertex] > 1) {
      if constexpr (Coder::encodes)
        for (std::uint32_t wedge = ring_[guess]; wedge != source && steps < 15; wedge = ring_[wedge])
          ++steps;
      steps = codeTree(coder_, wedgeModels::step, 4, steps);
    }
    if (steps < 15) {
      std::uint32_t wedge = ring_[guess];
      for (; steps > 0; --steps)
        wedge = ring_[wedge];
      return wedge;
    }
    const std::uint32_t distance = codeNumber(coder_, wedgeModels::wedge, out_.count() - 1 - source);
    coder_.require(distance < out_.count() && out_.vertex[out_.count() - 1 - distance] == vertex,
                   "a wedge is named that is not one of its vertex");
    return out_.count() - 1 - distance;
  }

  std::uint32_t make(std::uint32_t corner) {
    const std::uint32_t wedge = out_.count(), vertex = connectivity_.vertex[corner];
    coder_.require(wedge < wedgeCount_, "there are more wedges than the header states");
    if (start_[vertex] == none) {
      start_[vertex] = wedge;
      ring_.push_back(wedge);
    } else {
      ring_.push_back(ring_[start_[vertex]]);
      ring_[start_[vertex]] = wedge;
      ++extra_[vertex];
    }
    out_.previous.push_back(made_[vertex]);
    made_[vertex] = wedge;
    out_.vertex.push_back(vertex);
    out_.corner.push_back(corner);
    if constexpr (Coder::encodes)
      numbers_[sourceWedge_(corner)] = wedge;
    return wedge;
  }

  Coder& coder_;
  const Connectivity& connectivity_;
  std::uint32_t wedgeCount_;
  SourceWedge sourceWedge_;
  Wedges out_;
  std::vector<std::uint32_t> ring_;    ///< per wedge: the next wedge of its vertex, in a circle
  std::vector<std::uint32_t> start_;   ///< per vertex: its first wedge
  std::vector<std::uint32_t> made_;    ///< per vertex: the wedge that was made last
  std::vector<std::uint32_t> latest_;  ///< per vertex: the wedge of its last coded corner
  std::vector<std::uint32_t> extra_;   ///< per vertex: wedges beyond the first
  std::vector<bool> isSplit_;          ///< per vertex: it has several wedges
  std::vector<std::uint32_t> numbers_; ///< source wedge -> wedge
};

} // namespace imgeo::compact
