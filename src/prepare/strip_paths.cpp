// Finds the paths of a strip of low cost by simulated annealing (Kirkpatrick et al. 1983): docs/decisions/strips.md.

#include "prepare/strip_paths.h"

#include "prepare/half_edges.h"
#include "prepare/strip_links.h"

#include <cassert>

namespace imgeo {

namespace {

/// Number of sweeps by effort 0 .. 9. The running time is proportional to it.
constexpr int sweepCounts[] = {2, 3, 4, 5, 6, 8, 16, 32, 64, 128};

/// Cools from a state in which paths change freely to one in which hardly any higher cost is accepted. A short search
/// begins cooler. The schedule is stated in weights and not in temperatures, since powers may be rounded differently
/// on other machines.
void anneal(StripLinks& links, int sweeps) {
  const float hot = sweeps < 64 ? 0.5f : 0.65f, cold = 0.37f; // weight of a cost of a quarter of an index
  XorShift64Star random;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    links.resample(hot + (cold - hot) * static_cast<float>(sweep) / static_cast<float>(sweeps - 1), random);
}

/// Collects the paths that the links form. The links form no cycles.
class PathReader {
public:
  PathReader(const StripLinks& links, std::span<const std::uint32_t> corners, std::span<const std::uint32_t> opposites)
      : links_(links), corners_(corners), opposites_(opposites), isRead_(links.triangleCount()) {}

  StripPaths run() && {
    for (std::uint32_t triangle = 0; triangle < isRead_.size(); ++triangle)
      if (links_.degree(triangle) < 2 && !isRead_[triangle] && !isDegenerate(triangle))
        readFrom(triangle);
    return std::move(paths_);
  }

private:
  bool isDegenerate(std::uint32_t triangle) const {
    const std::uint32_t* c = &corners_[3 * std::size_t{triangle}];
    return c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
  }

  /// The linked half-edge of a triangle besides `entryHalfEdge`, or noHalfEdge.
  std::uint32_t otherLink(std::uint32_t triangle, std::uint32_t entryHalfEdge) const {
    for (std::uint32_t i = 0; i < 3; ++i)
      if (3 * triangle + i != entryHalfEdge && links_.isLinked(triangle, i))
        return 3 * triangle + i;
    return noHalfEdge;
  }

  void readFrom(std::uint32_t triangle) {
    for (std::uint32_t entryHalfEdge = noHalfEdge;;) {
      isRead_[triangle] = true;
      const std::uint32_t exitHalfEdge = otherLink(triangle, entryHalfEdge);
      paths_.halfEdges.push_back(exitHalfEdge != noHalfEdge    ? exitHalfEdge
                                 : entryHalfEdge != noHalfEdge ? nextHalfEdge(entryHalfEdge)
                                                               : 3 * triangle);
      if (exitHalfEdge == noHalfEdge)
        break;
      entryHalfEdge = opposites_[exitHalfEdge];
      triangle = entryHalfEdge / 3;
    }
    paths_.ends.push_back(static_cast<std::uint32_t>(paths_.halfEdges.size()));
  }

  const StripLinks& links_;
  std::span<const std::uint32_t> corners_, opposites_;
  std::vector<bool> isRead_;
  StripPaths paths_;
};

} // namespace

StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> opposites,
                          std::size_t vertexCount, int effort) {
  assert(effort >= 0 && effort <= 9);
  StripLinks links(corners, opposites, vertexCount);
  anneal(links, sweepCounts[effort]);
  links.breakCycles();
  return PathReader(links, corners, opposites).run();
}

} // namespace imgeo
