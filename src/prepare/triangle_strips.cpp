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
/// One end of a trail, which is a sequence of paths: 2 * trail, plus 1 for its last path.
using TrailEnd = std::uint32_t;

/// Minimum number of separate triangles; fewer become part of the strip. A draw of their own takes some twenty bytes of
/// the document and one draw call in each frame, and saves two indices a triangle.
constexpr std::size_t minSeparateTriangles = 32;

/// Chooses the order and the directions of paths and joins them.
///
/// A strip that ends in vertices y, z continues with a path of n triangles at the cost of n + 2 indices where the
/// path's tip is z, n + 3 where the tip is y or its first edge begins at z, and n + 4 elsewhere. So each path is taken
/// as a line between its two tips, and these lines are joined in the minimum number of trails (walks that repeat no
/// line: findLineStrips). A path of one triangle is a line between any two of its corners.
class Stitcher {
public:
  Stitcher(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort)
      : corners_(corners), opposites_(oppositeHalfEdges(corners)),
        paths_(findStripPaths(corners, opposites_, vertexCount, effort)), tips_(tipsOfPaths(vertexCount)),
        trails_(findLineStrips(tips_, vertexCount)), used_(trails_.count()) {
    for (TrailEnd end = 0; end < 2 * trails_.count(); ++end) {
      const std::uint32_t halfEdge = firstHalfEdge(pathEnd(end, 0));
      endCorners_.insert(endCorners_.end(), {tipOf(halfEdge), corners_[halfEdge], corners_[nextHalfEdge(halfEdge)]});
    }
    endsAt_ = incidenceOf(endCorners_.size(), vertexCount, [&](std::size_t i) { return endCorners_[i]; });
    endsLeft_.resize(vertexCount);
    for (std::uint32_t vertex = 0; vertex < vertexCount; ++vertex)
      endsLeft_[vertex] = static_cast<std::uint32_t>(endsAt_.of(vertex).size());
  }

  TriangleStrips run() && {
    result_.strip.reserve(paths_.halfEdges.size() + 4 * paths_.count());
    separateLoneTriangles();
    findRequiredParities();
    for (std::optional<TrailEnd> next = findNext(); next; next = findNext())
      append(*next);
    return std::move(result_);
  }

private:
  bool isSingle(std::uint32_t path) const { return paths_.path(path).size() == 1; }
  std::uint32_t tipOf(std::uint32_t halfEdge) const { return corners_[previousHalfEdge(halfEdge)]; }

  /// The two tips of every path. A single triangle takes as tips, where it can, corners at which an odd number of other
  /// paths end, since each trail begins and ends at such a vertex.
  std::vector<std::uint32_t> tipsOfPaths(std::size_t vertexCount) const {
    std::vector<std::uint32_t> tips(2 * paths_.count());
    std::vector<bool> isOdd(vertexCount);
    const auto setTip = [&](PathEnd end, std::uint32_t vertex) {
      tips[end] = vertex;
      isOdd[vertex] = !isOdd[vertex];
    };
    for (std::uint32_t path = 0; path < paths_.count(); ++path)
      if (!isSingle(path)) {
        const std::span<const std::uint32_t> halfEdges = paths_.path(path);
        setTip(2 * path, tipOf(halfEdges.front()));
        setTip(2 * path + 1, tipOf(opposites_[halfEdges[halfEdges.size() - 2]]));
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

  /// The half-edge by which a walk from `end` leaves the first triangle; in a single triangle, the half-edge opposite
  /// its tip.
  std::uint32_t firstHalfEdge(PathEnd end) const {
    const std::span<const std::uint32_t> halfEdges = paths_.path(end / 2);
    if (halfEdges.size() > 1)
      return end % 2 == 0 ? halfEdges.front() : opposites_[halfEdges[halfEdges.size() - 2]];
    std::uint32_t halfEdge = halfEdges.front();
    while (tipOf(halfEdge) != tips_[end])
      halfEdge = nextHalfEdge(halfEdge);
    return halfEdge;
  }

  /// The n-th path in a walk along a trail from `end`, as the end at which the walk enters it.
  PathEnd pathEnd(TrailEnd end, std::size_t n) const {
    const std::span<const std::uint32_t> trail = trails_.strip(end / 2);
    return end % 2 == 0 ? trail[n] : trail[trail.size() - 1 - n] ^ 1;
  }

  void separateLoneTriangles() {
    const auto isLone = [&](std::uint32_t trail) {
      return trails_.strip(trail).size() == 1 && isSingle(pathEnd(2 * trail, 0) / 2);
    };
    std::vector<std::uint32_t> lone;
    for (std::uint32_t trail = 0; trail < trails_.count(); ++trail)
      if (isLone(trail))
        lone.push_back(trail);
    if (lone.size() < minSeparateTriangles)
      return;
    for (const std::uint32_t trail : lone) {
      used_[trail] = true;
      const std::uint32_t first = paths_.path(pathEnd(2 * trail, 0) / 2).front() / 3 * 3;
      result_.triangles.insert(result_.triangles.end(), {corners_[first], corners_[first + 1], corners_[first + 2]});
    }
  }

  /// The orientation alternates along a strip. So a path fits the strip either at even or at odd indices, and costs one
  /// index more at the others. The order and the directions of trails are chosen to save such indices.
  void findRequiredParities() {
    requiredParities_.resize(2 * paths_.count());
    lengths_.resize(paths_.count());
    for (PathEnd end = 0; end < 2 * paths_.count(); ++end) {
      const std::size_t count = paths_.path(end / 2).size();
      const std::uint32_t to = corners_[nextHalfEdge(firstHalfEdge(end))];
      requiredParities_[end] = count == 2                                             ? Parity::any
                               : (count == 1 ? tips_[end ^ 1] : keptAt(end, 1)) == to ? Parity::even
                                                                                      : Parity::odd;
      std::size_t swaps = 0;
      for (std::size_t i = 2; i + 1 < count; ++i)
        swaps += keptAt(end, i) != tipOf(opposites_[halfEdgeAt(end, i - 2)]);
      lengths_[end / 2] = count + 2 + swaps;
    }
    parityCosts_.resize(std::size_t{4} * trails_.count());
    for (TrailEnd end = 0; end < 2 * trails_.count(); ++end)
      for (std::size_t parity = 0; parity < 2; ++parity)
        parityCosts_[std::size_t{2} * end + parity] = parityCost(end, parity);
  }

  /// Number of additional indices for parity along a trail whose first triangle begins at an even or odd index.
  std::uint32_t parityCost(TrailEnd end, std::size_t parity) const {
    const std::size_t count = trails_.strip(end / 2).size();
    std::uint32_t cost = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const PathEnd path = pathEnd(end, n);
      const bool isFree = requiredParities_[path] == Parity::any || (isSingle(path / 2) && n + 1 == count);
      const bool isWrong = !isFree && static_cast<std::size_t>(requiredParities_[path]) != parity;
      cost += isWrong;
      parity = (parity + lengths_[path / 2] + isWrong) % 2;
    }
    return cost;
  }

  /// The end of the unused trail that continues the strip at the least cost, among those that touch its last two
  /// vertices and the next few in order. Nothing where all trails are used.
  std::optional<TrailEnd> findNext() {
    constexpr std::uint32_t maxCandidates = 6;
    while (firstUnused_ < trails_.count() && used_[firstUnused_])
      ++firstUnused_;
    const std::vector<std::uint32_t>& strip = result_.strip;
    std::optional<TrailEnd> best;
    int bestCost = 0;
    const auto consider = [&](TrailEnd end, std::uint32_t joins) {
      // Relative to the mean cost of this trail, since each trail has to be used once.
      int cost = static_cast<int>(4 * (joins + parityCosts_[std::size_t{2} * end + (strip.size() + joins) % 2]));
      for (std::uint32_t i = 0; i < 4; ++i)
        cost -= static_cast<int>(parityCosts_[std::size_t{4} * (end / 2) + i]);
      if (!best || cost < bestCost)
        best = end, bestCost = cost;
    };
    if (!strip.empty()) {
      const std::uint32_t edgeStart = strip.size() % 2 == 0 ? 2 : 1;
      visitEnds(strip.back(), [&](TrailEnd end, std::uint32_t corner) {
        if (corner == 0 || corner == edgeStart)
          consider(end, corner == 0 ? 0 : 1);
      });
      visitEnds(strip[strip.size() - 2], [&](TrailEnd end, std::uint32_t corner) {
        if (corner == 0)
          consider(end, 1);
      });
    }
    const std::uint32_t joins = strip.empty() ? 0 : 2;
    for (std::uint32_t trail = firstUnused_, few = 0; trail < trails_.count() && few < maxCandidates; ++trail)
      if (!used_[trail]) {
        consider(2 * trail, joins);
        consider(2 * trail + 1, joins);
        ++few;
      }
    return best;
  }

  /// Calls visit(end, corner) for up to 64 ends of unused trails that touch `vertex`: corner 0 is the tip of the end,
  /// corners 1 and 2 are the vertices of its first edge.
  template <typename Visit> void visitEnds(std::uint32_t vertex, Visit visit) {
    constexpr std::uint32_t maxEnds = 64;
    std::uint32_t* ends = endsAt_.corners.data() + endsAt_.offsets[vertex];
    std::uint32_t& left = endsLeft_[vertex];
    for (std::uint32_t i = 0; i < left && i < maxEnds;) {
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
    const std::size_t count = trails_.strip(end / 2).size();
    for (std::size_t n = 0; n < count; ++n) {
      const PathEnd path = pathEnd(end, n);
      if (isSingle(path / 2) && n + 1 < count)
        appendSingle(path);
      else
        appendPath(path);
    }
  }

  /// The half-edge by which a walk from `end` leaves triangle i.
  std::uint32_t halfEdgeAt(PathEnd end, std::size_t i) const {
    const std::span<const std::uint32_t> halfEdges = paths_.path(end / 2);
    if (end % 2 == 0 || i + 1 == halfEdges.size())
      return halfEdges[end % 2 == 0 ? i : 0];
    return opposites_[halfEdges[halfEdges.size() - 2 - i]];
  }

  /// The vertex that the edge into triangle i and the edge out of it share.
  std::uint32_t keptAt(PathEnd end, std::size_t i) const {
    const std::uint32_t entered = opposites_[halfEdgeAt(end, i - 1)];
    return corners_[halfEdgeAt(end, i) == nextHalfEdge(entered) ? nextHalfEdge(entered) : entered];
  }

  void appendPath(PathEnd end) {
    std::vector<std::uint32_t>& strip = result_.strip;
    const std::size_t count = paths_.path(end / 2).size();
    appendFirst(firstHalfEdge(end));
    for (std::size_t i = 1; i < count; ++i) {
      // Where the path continues at the edge of the older vertex, a swap repeats that vertex.
      if (i + 1 < count && strip.back() != keptAt(end, i))
        strip.push_back(keptAt(end, i));
      strip.push_back(tipOf(opposites_[halfEdgeAt(end, i - 1)]));
    }
  }

  /// Appends a single triangle so that the strip ends in its other tip.
  void appendSingle(PathEnd end) {
    appendFirst(firstHalfEdge(end));
    if (result_.strip.back() == tips_[end ^ 1])
      return;
    // Repeating the first vertex exchanges the other two.
    const std::array<std::uint32_t, 2> edge{result_.strip[result_.strip.size() - 2], result_.strip.back()};
    result_.strip.resize(result_.strip.size() - 2);
    result_.strip.insert(result_.strip.end(), {tips_[end], edge[1], edge[0]});
  }

  /// Joins the triangle of `halfEdge` to the strip: its tip first, then the vertices of `halfEdge`.
  void appendFirst(std::uint32_t halfEdge) {
    std::vector<std::uint32_t>& strip = result_.strip;
    const std::uint32_t tip = tipOf(halfEdge), from = corners_[halfEdge], to = corners_[nextHalfEdge(halfEdge)];
    if (!strip.empty()) {
      const std::uint32_t last = strip.back(), beforeLast = strip[strip.size() - 2];
      const std::uint32_t edgeStart = strip.size() % 2 == 0 ? to : from; // if one index is inserted before
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
  std::vector<std::uint32_t> opposites_;
  StripPaths paths_;
  std::vector<std::uint32_t> tips_;       ///< by path end
  LineStrips trails_;                     ///< trails of paths; corners are path ends
  std::vector<bool> used_;                ///< by trail
  std::vector<std::uint32_t> endCorners_; ///< three for each trail end: its tip and the vertices of its first half-edge
  Incidence endsAt_;                      ///< vertex -> indices in endCorners_
  std::vector<std::uint32_t> endsLeft_;   ///< by vertex: number of its entries in endsAt_ that are not known to be used
  std::vector<Parity> requiredParities_;  ///< by path end: parity of the index at which its first triangle has to begin
  std::vector<std::size_t> lengths_;      ///< by path: indices, if it begins at the required parity
  std::vector<std::uint32_t> parityCosts_; ///< by trail end and parity of the index at which it begins
  std::uint32_t firstUnused_ = 0;          ///< all trails before it are used
  TriangleStrips result_;
};

} // namespace

TriangleStrips makeTriangleStrips(std::span<const std::uint32_t> corners, std::size_t vertexCount, int effort) {
  return Stitcher(corners, vertexCount, effort).run();
}

} // namespace imgeo
