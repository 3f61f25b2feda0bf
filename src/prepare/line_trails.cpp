// Hierholzer and Wiener, "Über die Möglichkeit, einen Linienzug ohne Wiederholung
// und ohne Unterbrechung zu umfahren", 1873: where an even number of lines ends at
// every vertex, one closed trail draws them all. Vertices where it is odd get one
// more line, which no pen draws, two by two; it is where the trails are cut.

#include "prepare/line_trails.h"

#include "prepare/incidence.h"

#include <cassert>

namespace imgeo {

namespace {

class TrailWalk {
public:
  TrailWalk(std::span<const std::uint32_t> corners, std::size_t vertexCount)
      : corners_(corners.begin(), corners.end()), lineCount_(corners.size() / 2) {
    std::vector<bool> isOdd(vertexCount);
    for (const std::uint32_t vertex : corners)
      isOdd[vertex] = !isOdd[vertex];
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      if (isOdd[vertex])
        corners_.push_back(vertex);
    incidence_ =
        incidenceOf(corners_.size(), vertexCount, [&](std::size_t corner) { return corners_[corner]; });
    // Taken from the back, the undrawn line of a vertex comes first and the others
    // from last to first; the trail comes out the other way round.
    left_.assign(incidence_.offsets.begin() + 1, incidence_.offsets.end());
    isUsed_.resize(corners_.size() / 2);
    trails_.vertices.reserve(lineCount_ + vertexCount);
  }

  LineTrails run() && {
    for (std::size_t corner = 2 * lineCount_; corner < corners_.size(); ++corner)
      walkFrom(corners_[corner]);
    for (const std::uint32_t vertex : corners_)
      walkFrom(vertex);
    return std::move(trails_);
  }

private:
  static constexpr std::uint32_t none = 0xffffffff;

  struct Step {
    std::uint32_t vertex, line; ///< and by which line it was reached
  };

  /// The closed trail through a vertex, and with it every line that hangs together with it.
  void walkFrom(std::uint32_t start) {
    path_.push_back({start, none});
    while (!path_.empty()) {
      const Step last = path_.back();
      if (const std::uint32_t corner = takeLine(last.vertex); corner != none) {
        path_.push_back({corners_[corner ^ 1], corner / 2});
        continue;
      }
      path_.pop_back();
      trails_.vertices.push_back(last.vertex);
      if (last.line >= lineCount_) // undrawn, or none
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
    if (trails_.vertices.size() - begin < 2)
      trails_.vertices.resize(begin);
    else
      trails_.ends.push_back(static_cast<std::uint32_t>(trails_.vertices.size()));
  }

  std::vector<std::uint32_t> corners_; ///< two a line; the undrawn lines last
  std::size_t lineCount_;              ///< of those that are drawn
  Incidence incidence_;
  std::vector<std::uint32_t> left_; ///< by vertex: where its corners not yet looked at end
  std::vector<bool> isUsed_;        ///< by line
  std::vector<Step> path_;
  LineTrails trails_;
};

} // namespace

LineTrails findLineTrails(std::span<const std::uint32_t> corners, std::size_t vertexCount) {
  assert(corners.size() % 2 == 0);
  return TrailWalk(corners, vertexCount).run();
}

} // namespace imgeo
