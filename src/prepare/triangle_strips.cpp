#include "prepare/triangle_strips.h"

#include "prepare/half_edges.h"
#include "prepare/incidence.h"
#include "prepare/line_strips.h"
#include "prepare/strip_paths.h"

#include <algorithm>
#include <array>
#include <optional>

namespace imgeo {

namespace {

/// One end of a path: 2 * path, plus 1 for its last triangle.
using PathEnd = std::uint32_t;
/// One end of a trail of paths: 2 * trail, plus 1 for its last path.
using TrailEnd = std::uint32_t;

/// Fewer separate triangles than this are stitched after all: a draw takes some
/// twenty bytes of the document and a call each frame, and saves two indices a triangle.
constexpr std::size_t fewestSeparate = 32;

/// Orders paths, picks their directions and writes them one behind the other.
///
/// A strip that ends in vertices y, z goes on with a path of n triangles at the
/// cost of n + 2 indices where the path's tip is z, n + 3 where the tip is y or
/// its first edge begins at z, n + 4 elsewhere. So paths are lines between their
/// tips, and the strip draws them in trails, of which there are as few as there
/// can be; a path of one triangle is a line between any two of its corners.
class Stitcher {
public:
  Stitcher(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort)
      : corners_(corners), across_(oppositeHalfEdges(corners)),
        paths_(findStripPaths(corners, across_, vertexCount, effort)), tips_(tipsOfPaths(vertexCount)),
        trails_(findLineStrips(tips_, vertexCount)), used_(trails_.count()) {
    for (TrailEnd end = 0; end < 2 * trails_.count(); ++end) {
      const std::uint32_t side = firstSide(pathEnd(end, 0));
      endCorners_.insert(endCorners_.end(), {tipOf(side), corners_[side], corners_[nextHalfEdge(side)]});
    }
    endsAt_ = incidenceOf(endCorners_.size(), vertexCount, [&](std::size_t i) { return endCorners_[i]; });
    endsLeft_.resize(vertexCount);
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      endsLeft_[vertex] = static_cast<std::uint32_t>(endsAt_.of(vertex).size());
  }

  Strips run() && {
    result_.strip.reserve(paths_.sides.size() + 4 * paths_.count());
    separateLoneTriangles();
    findWantedParities();
    for (std::optional<TrailEnd> next = findNext(); next; next = findNext())
      append(*next);
    return std::move(result_);
  }

private:
  bool isSingle(std::uint32_t path) const { return paths_.path(path).size() == 1; }
  std::uint32_t tipOf(std::uint32_t side) const { return corners_[previousHalfEdge(side)]; }

  /// The two tips of every path. Those of a single triangle are corners where an odd number of
  /// other paths end, if it has such: each trail begins and ends at one.
  std::vector<std::uint32_t> tipsOfPaths(std::size_t vertexCount) const {
    std::vector<std::uint32_t> tips(2 * paths_.count());
    std::vector<bool> isOdd(vertexCount);
    const auto setTip = [&](PathEnd end, std::uint32_t vertex) {
      tips[end] = vertex;
      isOdd[vertex] = !isOdd[vertex];
    };
    for (std::uint32_t path = 0; path < paths_.count(); ++path)
      if (!isSingle(path)) {
        const std::span<const std::uint32_t> sides = paths_.path(path);
        setTip(2 * path, tipOf(sides.front()));
        setTip(2 * path + 1, tipOf(across_[sides[sides.size() - 2]]));
      }
    for (std::uint32_t path = 0; path < paths_.count(); ++path)
      if (isSingle(path)) {
        const std::uint32_t first = paths_.path(path).front() / 3 * 3;
        std::array<std::uint32_t, 3> vertices{corners_[first], corners_[first + 1], corners_[first + 2]};
        std::stable_partition(vertices.begin(), vertices.end(), [&](std::uint32_t v) { return isOdd[v]; });
        setTip(2 * path, vertices[0]);
        setTip(2 * path + 1, vertices[1]);
      }
    return tips;
  }

  /// The side by which a walk from `end` leaves its first triangle; of a single one, the side
  /// opposite its tip.
  std::uint32_t firstSide(PathEnd end) const {
    const std::span<const std::uint32_t> sides = paths_.path(end / 2);
    if (sides.size() > 1)
      return end % 2 == 0 ? sides.front() : across_[sides[sides.size() - 2]];
    std::uint32_t side = sides.front();
    while (tipOf(side) != tips_[end])
      side = nextHalfEdge(side);
    return side;
  }

  /// The path that comes n-th in a walk along a trail from `end`, and the end that it is walked from.
  PathEnd pathEnd(TrailEnd end, std::size_t n) const {
    const std::span<const std::uint32_t> trail = trails_.trail(end / 2);
    return end % 2 == 0 ? trail[n] : trail[trail.size() - 1 - n] ^ 1;
  }

  void separateLoneTriangles() {
    const auto isLone = [&](std::uint32_t trail) {
      return trails_.trail(trail).size() == 1 && isSingle(pathEnd(2 * trail, 0) / 2);
    };
    std::vector<std::uint32_t> lone;
    for (std::uint32_t trail = 0; trail < trails_.count(); ++trail)
      if (isLone(trail))
        lone.push_back(trail);
    if (lone.size() < fewestSeparate)
      return;
    for (const std::uint32_t trail : lone) {
      used_[trail] = true;
      const std::uint32_t first = paths_.path(pathEnd(2 * trail, 0) / 2).front() / 3 * 3;
      result_.triangles.insert(result_.triangles.end(), {corners_[first], corners_[first + 1], corners_[first + 2]});
    }
  }

  /// In a strip every second triangle is mirrored, so a path begins either with its
  /// first turn or, for one index more, with the other; which one, the number of indices
  /// before it says. LineStrips come in an order and a direction that save such indices.
  void findWantedParities() {
    wanted_.resize(2 * paths_.count());
    lengths_.resize(paths_.count());
    for (PathEnd end = 0; end < 2 * paths_.count(); ++end) {
      const std::size_t count = paths_.path(end / 2).size();
      const std::uint32_t to = corners_[nextHalfEdge(firstSide(end))];
      wanted_[end] = count == 2                                             ? Parity::any
                     : (count == 1 ? tips_[end ^ 1] : keptAt(end, 1)) == to ? Parity::even
                                                                            : Parity::odd;
      std::size_t swaps = 0;
      for (std::size_t i = 2; i + 1 < count; ++i)
        swaps += keptAt(end, i) != tipOf(across_[sideAt(end, i - 2)]);
      lengths_[end / 2] = count + 2 + swaps;
    }
    turnCosts_.resize(std::size_t{4} * trails_.count());
    for (TrailEnd end = 0; end < 2 * trails_.count(); ++end)
      for (std::size_t parity = 0; parity < 2; ++parity)
        turnCosts_[std::size_t{2} * end + parity] = turnCost(end, parity);
  }

  /// Indices that wrong first turns cost along a trail whose first triangle begins at an even or odd place.
  std::uint32_t turnCost(TrailEnd end, std::size_t parity) const {
    const std::size_t count = trails_.trail(end / 2).size();
    std::uint32_t cost = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const PathEnd path = pathEnd(end, n);
      const bool isFree = wanted_[path] == Parity::any || (isSingle(path / 2) && n + 1 == count);
      const bool isWrong = !isFree && static_cast<std::size_t>(wanted_[path]) != parity;
      cost += isWrong;
      parity = (parity + lengths_[path / 2] + isWrong) % 2;
    }
    return cost;
  }

  /// The end of a trail that goes on best from the strip's last two vertices: among
  /// those that touch them, and the next few in order. Nothing at the end.
  std::optional<TrailEnd> findNext() {
    constexpr std::uint32_t nextFew = 6;
    while (firstUnused_ < trails_.count() && used_[firstUnused_])
      ++firstUnused_;
    const std::vector<std::uint32_t>& strip = result_.strip;
    std::optional<TrailEnd> best;
    int bestCost = 0;
    const auto consider = [&](TrailEnd end, std::uint32_t joins) {
      // Compared with what this trail would cost on average: it has to come some time.
      int cost = static_cast<int>(4 * (joins + turnCosts_[std::size_t{2} * end + (strip.size() + joins) % 2]));
      for (std::uint32_t i = 0; i < 4; ++i)
        cost -= static_cast<int>(turnCosts_[std::size_t{4} * (end / 2) + i]);
      if (!best || cost < bestCost)
        best = end, bestCost = cost;
    };
    if (!strip.empty()) {
      const std::uint32_t edgeStart = strip.size() % 2 == 0 ? 2 : 1;
      visitEnds(strip.back(), [&](TrailEnd end, std::uint32_t place) {
        if (place == 0 || place == edgeStart)
          consider(end, place == 0 ? 0 : 1);
      });
      visitEnds(strip[strip.size() - 2], [&](TrailEnd end, std::uint32_t place) {
        if (place == 0)
          consider(end, 1);
      });
    }
    const std::uint32_t joins = strip.empty() ? 0 : 2;
    for (std::uint32_t trail = firstUnused_, few = 0; trail < trails_.count() && few < nextFew; ++trail)
      if (!used_[trail]) {
        consider(2 * trail, joins);
        consider(2 * trail + 1, joins);
        ++few;
      }
    return best;
  }

  /// Calls visit(end, place) for ends of unused trails of which `vertex` is the
  /// tip (place 0) or another corner; of some tens at most.
  template <typename Visit> void visitEnds(std::uint32_t vertex, Visit visit) {
    constexpr std::uint32_t enough = 64;
    std::uint32_t* ends = endsAt_.corners.data() + endsAt_.offsets[vertex];
    std::uint32_t& left = endsLeft_[vertex];
    for (std::uint32_t i = 0; i < left && i < enough;) {
      if (used_[ends[i] / 6]) {
        ends[i] = ends[--left];
        continue;
      }
      visit(ends[i] / 3, ends[i] % 3);
      ++i;
    }
  }

  void append(TrailEnd end) {
    used_[end / 2] = true;
    const std::size_t count = trails_.trail(end / 2).size();
    for (std::size_t n = 0; n < count; ++n) {
      const PathEnd path = pathEnd(end, n);
      if (isSingle(path / 2) && n + 1 < count)
        appendSingle(path);
      else
        appendPath(path);
    }
  }

  /// By which triangle i of a walk from `end` is left.
  std::uint32_t sideAt(PathEnd end, std::size_t i) const {
    const std::span<const std::uint32_t> sides = paths_.path(end / 2);
    if (end % 2 == 0 || i + 1 == sides.size())
      return sides[end % 2 == 0 ? i : 0];
    return across_[sides[sides.size() - 2 - i]];
  }

  /// The vertex of the edge into triangle i that the edge out of it shares.
  std::uint32_t keptAt(PathEnd end, std::size_t i) const {
    const std::uint32_t entered = across_[sideAt(end, i - 1)];
    return corners_[sideAt(end, i) == nextHalfEdge(entered) ? nextHalfEdge(entered) : entered];
  }

  void appendPath(PathEnd end) {
    std::vector<std::uint32_t>& strip = result_.strip;
    const std::size_t count = paths_.path(end / 2).size();
    appendFirst(firstSide(end));
    for (std::size_t i = 1; i < count; ++i) {
      // A triangle that is left by the edge of the older vertex needs that vertex again.
      if (i + 1 < count && strip.back() != keptAt(end, i))
        strip.push_back(keptAt(end, i));
      strip.push_back(tipOf(across_[sideAt(end, i - 1)]));
    }
  }

  /// A triangle that must end in its other tip.
  void appendSingle(PathEnd end) {
    appendFirst(firstSide(end));
    if (result_.strip.back() == tips_[end ^ 1])
      return;
    // Once more the first vertex turns the other two around.
    const std::array<std::uint32_t, 2> edge{result_.strip[result_.strip.size() - 2], result_.strip.back()};
    result_.strip.resize(result_.strip.size() - 2);
    result_.strip.insert(result_.strip.end(), {tips_[end], edge[1], edge[0]});
  }

  /// Joins the triangle of `side`, its tip first and the edge of `side` last.
  void appendFirst(std::uint32_t side) {
    std::vector<std::uint32_t>& strip = result_.strip;
    const std::uint32_t tip = tipOf(side), from = corners_[side], to = corners_[nextHalfEdge(side)];
    if (!strip.empty()) {
      const std::uint32_t last = strip.back(), beforeLast = strip[strip.size() - 2];
      const std::uint32_t edgeStart = strip.size() % 2 == 0 ? to : from; // were there one index between
      if (tip == beforeLast)
        strip.push_back(tip);
      else if (tip != last)
        strip.push_back(last);
      if (tip != last && tip != beforeLast && edgeStart != last)
        strip.push_back(tip);
    }
    const bool odd = strip.size() % 2 == 1;
    strip.insert(strip.end(), {tip, odd ? to : from, odd ? from : to});
  }

  enum class Parity : std::uint8_t { even, odd, any };

  std::span<const std::uint32_t> corners_;
  std::vector<std::uint32_t> across_;
  StripPaths paths_;
  std::vector<std::uint32_t> tips_;       ///< by path end
  LineStrips trails_;                     ///< of path ends
  std::vector<bool> used_;                ///< by trail
  std::vector<std::uint32_t> endCorners_; ///< three a trail end: its tip and the edge of its first side
  Incidence endsAt_;                      ///< vertex -> its places in endCorners_
  std::vector<std::uint32_t> endsLeft_;   ///< by vertex: how many of these are not known to be used
  std::vector<Parity> wanted_;            ///< by path end: of the place at which its first triangle is to begin
  std::vector<std::size_t> lengths_;      ///< by path: indices, where it begins as wanted
  std::vector<std::uint32_t> turnCosts_;  ///< by trail end and parity of the place that it begins at
  std::uint32_t firstUnused_ = 0;         ///< trails before it are used
  Strips result_;
};

} // namespace

Strips makeStrips(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort) {
  return Stitcher(corners, vertexCount, effort).run();
}

} // namespace imgeo
