// Hierholzer's algorithm (Hierholzer and Wiener, "Über die Möglichkeit, einen Linienzug ohne Wiederholung und ohne
// Unterbrechung zu umfahren", 1873): a connected graph whose vertices all have even degree has a closed trail through
// all edges (an Euler circuit). Additional edges connect the vertices of odd degree in pairs; the circuit is cut into
// strips at these edges.

#include "prepare/line_strips.h"

#include "prepare/incidence.h"

#include <cassert>

namespace imgeo {

namespace {

class EulerCircuits {
public:
  EulerCircuits(std::span<const std::uint32_t> vertices, std::size_t vertexCount)
      : vertices_(vertices.begin(), vertices.end()), inputCornerCount_(vertices.size()) {
    std::vector<bool> isOdd(vertexCount);
    for (const std::uint32_t vertex : vertices)
      isOdd[vertex] = !isOdd[vertex];
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      if (isOdd[vertex])
        vertices_.push_back(vertex);
    incidence_ = incidenceOf(vertices_.size(), vertexCount, [&](std::size_t corner) { return vertices_[corner]; });
    // Lines are taken from the back of each vertex's list: first its additional line, then the others from last to
    // first. The circuit is output in reverse, so that an open line keeps its direction.
    unvisitedEnd_.assign(incidence_.offsets.begin() + 1, incidence_.offsets.end());
    isUsed_.resize(vertices_.size() / 2);
    strips_.corners.reserve(inputCornerCount_ / 2);
  }

  LineStrips run() && {
    for (std::size_t corner = inputCornerCount_; corner < vertices_.size(); ++corner)
      walkFrom(vertices_[corner]);
    for (const std::uint32_t vertex : vertices_)
      walkFrom(vertex);
    return std::move(strips_);
  }

private:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Step {
    std::uint32_t vertex;
    std::uint32_t corner; ///< the corner at which the previous line has arrived
  };

  /// Outputs the Euler circuit of the connected component of `start`.
  void walkFrom(std::uint32_t start) {
    path_.push_back({start, none});
    while (!path_.empty()) {
      const Step last = path_.back();
      if (const std::uint32_t corner = takeLine(last.vertex); corner != none) {
        path_.push_back({vertices_[corner ^ 1], corner ^ 1});
        continue;
      }
      path_.pop_back();
      if (last.corner < inputCornerCount_)
        strips_.corners.push_back(last.corner);
      else
        endStrip();
    }
  }

  /// Takes an unused line at `vertex` and returns its corner there, or none.
  std::uint32_t takeLine(std::uint32_t vertex) {
    while (unvisitedEnd_[vertex] > incidence_.offsets[vertex]) {
      const std::uint32_t corner = incidence_.corners[--unvisitedEnd_[vertex]];
      if (isUsed_[corner / 2])
        continue;
      isUsed_[corner / 2] = true;
      return corner;
    }
    return none;
  }

  void endStrip() {
    const std::uint32_t begin = strips_.ends.empty() ? 0 : strips_.ends.back();
    if (strips_.corners.size() > begin)
      strips_.ends.push_back(static_cast<std::uint32_t>(strips_.corners.size()));
  }

  std::vector<std::uint32_t> vertices_; ///< by corner; those of the additional lines last
  std::size_t inputCornerCount_;
  Incidence incidence_;
  std::vector<std::uint32_t> unvisitedEnd_; ///< by vertex: end of the corners in its list that have not been visited
  std::vector<bool> isUsed_;                ///< by line
  std::vector<Step> path_;
  LineStrips strips_;
};

} // namespace

LineStrips findLineStrips(std::span<const std::uint32_t> vertices, std::size_t vertexCount) {
  assert(vertices.size() % 2 == 0);
  return EulerCircuits(vertices, vertexCount).run();
}

} // namespace imgeo
