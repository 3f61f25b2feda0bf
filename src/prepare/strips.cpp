#include "prepare/strips.h"

#include "prepare/dual_graph.h"
#include "prepare/incidence.h"
#include "prepare/strip_paths.h"

#include <algorithm>
#include <optional>

namespace imgeo {

namespace {

/// One end of a path: 2 * path, plus 1 for its last triangle.
using PathEnd = std::uint32_t;

/// Orders paths, picks their directions and writes them one behind the other.
///
/// A strip that ends in vertices y, z goes on with a path of n triangles at the
/// cost of n + 2 indices where the path's tip is z, n + 3 where the tip is y or
/// its first edge begins at z, n + 4 elsewhere. So paths are edges between their
/// tips, and the strip is a walk in trails along them; as many trails are needed
/// as half the vertices where an odd number of edges meet, and they begin there.
class Stitcher {
public:
  Stitcher(std::span<const std::uint32_t> corners, std::size_t vertexCount)
      : corners_(corners), across_(sidesAcross(corners)),
        paths_(findStripPaths(corners, across_, vertexCount)), used_(paths_.count()), oddTips_(vertexCount) {
    endCorners_.reserve(6 * paths_.count());
    for (PathEnd end = 0; end < 2 * paths_.count(); ++end) {
      const std::uint32_t side = firstSide(end);
      endCorners_.insert(endCorners_.end(), {tipOf(side), corners_[side], corners_[sideAfter(side)]});
      if (!isSingle(end / 2))
        oddTips_[tipOf(side)] = !oddTips_[tipOf(side)];
    }
    endsAt_ = incidenceOf(endCorners_.size(), vertexCount, [&](std::size_t i) { return endCorners_[i]; });
    endsLeft_.resize(vertexCount);
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      endsLeft_[vertex] = static_cast<std::uint32_t>(endsAt_.of(vertex).size());
  }

  std::vector<std::uint32_t> run() && {
    strip_.reserve(paths_.sides.size() + 4 * paths_.count());
    for (PathEnd end = 0; end < 2 * paths_.count(); ++end)
      if (startsOdd(end))
        walkTrail(end);
    for (std::uint32_t path = 0; path < paths_.count(); ++path)
      if (!used_[path])
        walkTrail(2 * path);
    return std::move(strip_);
  }

private:
  bool isSingle(std::uint32_t path) const { return paths_.path(path).size() == 1; }
  std::uint32_t tipOf(std::uint32_t side) const { return corners_[sideBefore(side)]; }

  /// The side by which a walk from `end` leaves its first triangle.
  std::uint32_t firstSide(PathEnd end) const {
    const std::span<const std::uint32_t> sides = paths_.path(end / 2);
    return end % 2 == 0 || sides.size() == 1 ? sides.front() : across_[sides[sides.size() - 2]];
  }

  bool startsOdd(PathEnd end) const {
    return !used_[end / 2] && !isSingle(end / 2) && oddTips_[tipOf(firstSide(end))];
  }

  void walkTrail(PathEnd end) {
    for (std::optional<PathEnd> next = end; next; next = findNext())
      append(*next);
  }

  /// An end that goes on cheaply from the strip's last two vertices.
  std::optional<PathEnd> findNext() {
    const std::uint32_t last = strip_.back(), beforeLast = strip_[strip_.size() - 2];
    std::optional<PathEnd> found;
    visitEnds(last, [&](PathEnd end, std::uint32_t place) {
      const bool joinsAtTip = place == 0 || isSingle(end / 2);
      // A path at whose other corners the strip arrives begins a trail; it is
      // not to be torn out of the middle of one.
      const bool joinsAtEdge = place == (strip_.size() % 2 == 0 ? 2u : 1u) && startsOdd(end);
      if (joinsAtTip || (joinsAtEdge && !found))
        found = end;
      return joinsAtTip;
    });
    if (!found)
      visitEnds(beforeLast, [&](PathEnd end, std::uint32_t place) {
        if (place == 0 && startsOdd(end))
          found = end;
        return found.has_value();
      });
    return found;
  }

  /// Calls visit(end, place) for ends of unused paths of which `vertex` is the
  /// tip (place 0) or another corner, until it returns true; some tens at most.
  template <typename Visit> void visitEnds(std::uint32_t vertex, Visit visit) {
    constexpr std::uint32_t enough = 64;
    std::uint32_t* ends = endsAt_.corners.data() + endsAt_.offsets[vertex];
    std::uint32_t& left = endsLeft_[vertex];
    for (std::uint32_t i = 0; i < left && i < enough;) {
      if (used_[ends[i] / 6])
        ends[i] = ends[--left];
      else if (visit(ends[i] / 3, ends[i] % 3))
        return;
      else
        ++i;
    }
  }

  void append(PathEnd end) {
    const std::uint32_t path = end / 2;
    used_[path] = true;
    if (!isSingle(path))
      for (const PathEnd either : {2 * path, 2 * path + 1}) {
        const std::uint32_t tip = tipOf(firstSide(either));
        oddTips_[tip] = !oddTips_[tip];
      }
    const std::span<const std::uint32_t> sides = paths_.path(path);
    const auto side = [&](std::size_t i) { // by which triangle i of the walk is left
      if (end % 2 == 0 || i + 1 == sides.size())
        return sides[end % 2 == 0 ? i : 0];
      return across_[sides[sides.size() - 2 - i]];
    };
    appendFirst(isSingle(path) ? bestSide(side(0)) : side(0));
    for (std::size_t i = 1; i < sides.size(); ++i) {
      const std::uint32_t entered = across_[side(i - 1)];
      if (i + 1 < sides.size()) {
        // A triangle that is left by the edge of the older vertex needs that vertex again.
        const std::uint32_t kept = corners_[side(i) == sideAfter(entered) ? sideAfter(entered) : entered];
        if (strip_.back() != kept)
          strip_.push_back(kept);
      }
      strip_.push_back(tipOf(entered));
    }
  }

  /// The side of a lone triangle whose tip joins best.
  std::uint32_t bestSide(std::uint32_t side) const {
    if (strip_.empty())
      return side;
    for (const std::uint32_t vertex : {strip_.back(), strip_[strip_.size() - 2]})
      for (const std::uint32_t other : {side, sideAfter(side), sideBefore(side)})
        if (tipOf(other) == vertex)
          return other;
    return side;
  }

  /// Joins the triangle of `side`, its tip first and the edge of `side` last.
  void appendFirst(std::uint32_t side) {
    const std::uint32_t tip = tipOf(side), from = corners_[side], to = corners_[sideAfter(side)];
    if (!strip_.empty()) {
      const std::uint32_t last = strip_.back(), beforeLast = strip_[strip_.size() - 2];
      const std::uint32_t edgeStart = strip_.size() % 2 == 0 ? to : from; // were there one index between
      if (tip == beforeLast)
        strip_.push_back(tip);
      else if (tip != last)
        strip_.push_back(last);
      if (tip != last && tip != beforeLast && edgeStart != last)
        strip_.push_back(tip);
    }
    const bool odd = strip_.size() % 2 == 1;
    strip_.insert(strip_.end(), {tip, odd ? to : from, odd ? from : to});
  }

  std::span<const std::uint32_t> corners_;
  std::vector<std::uint32_t> across_;
  StripPaths paths_;
  std::vector<bool> used_;                ///< by path
  std::vector<bool> oddTips_;             ///< by vertex: an odd number of unused paths have a tip there
  std::vector<std::uint32_t> endCorners_; ///< three a path end: its tip and the edge of its first side
  Incidence endsAt_;                      ///< vertex -> its places in endCorners_
  std::vector<std::uint32_t> endsLeft_;   ///< by vertex: how many of these are not known to be used
  std::vector<std::uint32_t> strip_;
};

} // namespace

std::vector<std::uint32_t> stitchedStrip(std::span<const std::uint32_t> corners, std::size_t vertexCount) {
  return Stitcher(corners, vertexCount).run();
}

} // namespace imgeo
