#include "transcode/verify/foreign_site.h"

#include "transcode/verify/element_list.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

/// The lattice points of all vertices of a site, sorted, each once.
std::vector<Vec3u> pointsOf(const std::vector<IndexedPatch>& site) {
  std::vector<Vec3u> points;
  for (const IndexedPatch& patch : site)
    points.insert(points.end(), patch.positions.begin(), patch.positions.end());
  std::ranges::sort(points, precedes);
  points.erase(std::ranges::unique(points).begin(), points.end());
  return points;
}

/// The lattice points that another rounding may choose: one, two, four or eight.
std::vector<Vec3u> candidatesOf(Vec3u nearest, Vec3f position, const Lattice& lattice) {
  std::vector<Vec3u> candidates{nearest};
  for (int axis = 0; axis < 3; ++axis) {
    const double step = lattice.step * lattice.stretch[axis];
    if (!(step > 0))
      continue;
    const double off = (position[axis] - lattice.origin[axis]) / step - nearest[axis];
    const bool isUp = off > 0;
    if (std::abs(off) < 0.5 - foreignRounding || (isUp ? nearest[axis] == lattice.maximum() : nearest[axis] == 0))
      continue;
    for (std::size_t i = candidates.size(); i-- > 0;) {
      Vec3u other = candidates[i];
      other[axis] = isUp ? other[axis] + 1 : other[axis] - 1;
      candidates.push_back(other);
    }
  }
  return candidates;
}

} // namespace

std::vector<Vec3u> quantiseLike(const std::vector<IndexedPatch>& site, std::span<const Vec3f> positions,
                                const Lattice& lattice) {
  const std::vector<Vec3u> points = pointsOf(site);
  std::vector<Vec3u> quantised = quantise(positions, lattice);
  for (std::size_t i = 0; i < quantised.size(); ++i)
    for (const Vec3u& candidate : candidatesOf(quantised[i], positions[i], lattice))
      if (std::ranges::binary_search(points, candidate, precedes)) {
        quantised[i] = candidate;
        break;
      }
  return quantised;
}

} // namespace imgeo
