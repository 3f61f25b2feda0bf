// Hierholzer and Wiener, "Über die Möglichkeit, einen Linienzug ohne Wiederholung
// und ohne Unterbrechung zu umfahren", 1873: where an even number of lines ends at
// every vertex, one closed trail draws them all. Vertices where it is odd get one
// more line, which no pen draws, two by two; it is where the trails are cut.

#include "prepare/line_strips.h"

#include "prepare/incidence.h"

#include <cassert>

namespace imgeo {

namespace {

class TrailWalk {
public:
  TrailWalk(std::span<const std::uint32_t> vertices, std::size_t vertexCount)
      : vertices_(vertices.begin(), vertices.end()), drawnCorners_(vertices.size()) {
    std::vector<bool> isOdd(vertexCount);
    for (const std::uint32_t vertex : vertices)
      isOdd[vertex] = !isOdd[vertex];
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      if (isOdd[vertex])
        vertices_.push_back(vertex);
    incidence_ = incidenceOf(vertices_.size(), vertexCount, [&](std::size_t corner) { return vertices_[corner]; });
    // Taken from the back, the undrawn line of a vertex comes first and the others
    // from last to first; the trail comes out the other way round.
    left_.assign(incidence_.offsets.begin() + 1, incidence_.offsets.end());
    isUsed_.resize(vertices_.size() / 2);
    trails_.corners.reserve(drawnCorners_ / 2);
  }

  LineStrips run() && {
    for (std::size_t corner = drawnCorners_; corner < vertices_.size(); ++corner)
      walkFrom(vertices_[corner]);
    for (const std::uint32_t vertex : vertices_)
      walkFrom(vertex);
    return std::move(trails_);
  }

private:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Step {
    std::uint32_t vertex;
    std::uint32_t corner; ///< at which a line has led here
  };

  /// The closed trail through a vertex, and with it every line that hangs together with it.
  void walkFrom(std::uint32_t start) {
    path_.push_back({start, none});
    while (!path_.empty()) {
      const Step last = path_.back();
      if (const std::uint32_t corner = takeLine(last.vertex); corner != none) {
        path_.push_back({vertices_[corner ^ 1], corner ^ 1});
        continue;
      }
      path_.pop_back();
      if (last.corner < drawnCorners_)
        trails_.corners.push_back(last.corner);
      else
        endTrail();
    }
  }

  /// The corner at `vertex` of a line that has not been walked yet.
  std::uint32_t takeLine(std::uint32_t vertex) {
    while (left_[vertex] > incidence_.offsets[vertex]) {
      const std::uint32_t corner = incidence_.corners[--left_[vertex]];
      if (isUsed_[corner / 2])
        continue;
      isUsed_[corner / 2] = true;
      return corner;
    }
    return none;
  }

  void endTrail() {
    const std::uint32_t begin = trails_.ends.empty() ? 0 : trails_.ends.back();
    if (trails_.corners.size() > begin)
      trails_.ends.push_back(static_cast<std::uint32_t>(trails_.corners.size()));
  }

  std::vector<std::uint32_t> vertices_; ///< by corner; those of the undrawn lines last
  std::size_t drawnCorners_;
  Incidence incidence_;
  std::vector<std::uint32_t> left_; ///< by vertex: where its corners not yet looked at end
  std::vector<bool> isUsed_;        ///< by line
  std::vector<Step> path_;
  LineStrips trails_;
};

} // namespace

LineStrips findLineStrips(std::span<const std::uint32_t> vertices, std::size_t vertexCount) {
  assert(vertices.size() % 2 == 0);
  return TrailWalk(vertices, vertexCount).run();
}

} // namespace imgeo
