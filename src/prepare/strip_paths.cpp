// Simulated annealing (Kirkpatrick et al. 1983) of what the strip will cost:
// docs/decisions/strips.md.

#include "prepare/strip_paths.h"

#include "prepare/half_edges.h"
#include "prepare/strip_links.h"

#include <cassert>

namespace imgeo {

namespace {

/// By effort: time grows as they do.
constexpr int sweepsAt[] = {2, 3, 4, 5, 6, 8, 16, 32, 64, 128};

/// Cools from where paths move freely to where hardly anything dearer is drawn; a short
/// search has no time for so hot a beginning. In factors, not temperatures: no machine
/// rounds a power differently.
void anneal(StripLinks& links, int sweeps) {
  const float hot = sweeps < 64 ? 0.5f : 0.65f, cold = 0.37f; // the weight of a quarter of an index
  XorShift64Star random;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    links.redraw(hot + (cold - hot) * static_cast<float>(sweep) / static_cast<float>(sweeps - 1), random);
}

/// Reads the paths off the links, among which there are no rings.
class PathReader {
public:
  PathReader(const StripLinks& links, std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across)
      : links_(links), corners_(corners), across_(across), isRead_(links.triangleCount()) {}

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

  /// The linked side of a triangle that is not `entered`, or else noHalfEdge.
  std::uint32_t otherLink(std::uint32_t triangle, std::uint32_t entered) const {
    for (std::uint32_t i = 0; i < 3; ++i)
      if (3 * triangle + i != entered && links_.isLinked(triangle, i))
        return 3 * triangle + i;
    return noHalfEdge;
  }

  void readFrom(std::uint32_t triangle) {
    for (std::uint32_t entered = noHalfEdge;;) {
      isRead_[triangle] = true;
      const std::uint32_t left = otherLink(triangle, entered);
      paths_.sides.push_back(left != noHalfEdge ? left : entered != noHalfEdge ? nextHalfEdge(entered) : 3 * triangle);
      if (left == noHalfEdge)
        break;
      entered = across_[left];
      triangle = entered / 3;
    }
    paths_.ends.push_back(static_cast<std::uint32_t>(paths_.sides.size()));
  }

  const StripLinks& links_;
  std::span<const std::uint32_t> corners_, across_;
  std::vector<bool> isRead_;
  StripPaths paths_;
};

} // namespace

StripPaths findStripPaths(std::span<const std::uint32_t> corners, std::span<const std::uint32_t> across,
                          std::size_t vertexCount, int effort) {
  assert(effort >= 0 && effort <= 9);
  StripLinks links(corners, across, vertexCount);
  anneal(links, sweepsAt[effort]);
  links.openRings();
  return PathReader(links, corners, across).run();
}

} // namespace imgeo
