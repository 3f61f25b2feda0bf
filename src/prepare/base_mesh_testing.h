#pragma once
// Checks for cracks between the segments of a base mesh and whole patches. Header-only and for tests alone.

#include "prepare/base_mesh.h"
#include "scene/testing.h"

#include <gtest/gtest.h>
#include <map>
#include <tuple>

namespace imgeo::testing {

using PointKey = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

inline PointKey keyOf(const Vec3u& point) {
  return {point.x, point.y, point.z};
}

/// Directed edges between lattice points, in which opposite edges cancel out; each edge that remains is a crack.
class EdgeBalance {
public:
  void add(const Vec3u& a, const Vec3u& b, const Vec3u& c) {
    for (const auto& [from, to] : {std::pair(keyOf(a), keyOf(b)), {keyOf(b), keyOf(c)}, {keyOf(c), keyOf(a)}})
      if (from != to)
        counts_[std::minmax(from, to)] += from < to ? 1 : -1;
  }
  std::size_t cracks() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(counts_, [](const auto& entry) { return entry.second != 0; }));
  }

private:
  std::map<std::pair<PointKey, PointKey>, int> counts_;
};

/// Expects that mixtures of segments and patches have no cracks. The mesh must be closed.
inline void expectClosedMixtures(const BaseMesh& base, const std::vector<PatchTriangles>& patches) {
  Random random(static_cast<std::uint32_t>(patches.size()));
  for (int mixture = 0; mixture < 6; ++mixture) {
    std::vector<bool> hasArrived; // mixture 0 has no patches, mixture 1 all of them
    for (std::size_t segment = 0; segment < patches.size(); ++segment)
      hasArrived.push_back(mixture > 1 ? random.oneIn(2) : mixture == 1);
    EdgeBalance edges;
    for (std::size_t triangle = 0; triangle < base.triangleCount(); ++triangle)
      if (!hasArrived[base.segments[triangle]]) {
        const auto at = [&](std::size_t i) { return base.cornerPosition(3 * triangle + i); };
        edges.add(at(0), at(1), at(2));
      }
    for (std::size_t segment = 0; segment < patches.size(); ++segment)
      for (std::size_t corner = 0; hasArrived[segment] && corner < patches[segment].corners.size(); corner += 3) {
        const auto at = [&](std::size_t i) { return patches[segment].positions[patches[segment].corners[corner + i]]; };
        edges.add(at(0), at(1), at(2));
      }
    EXPECT_EQ(edges.cracks(), 0u) << "mixture " << mixture << " of " << patches.size() << " patches";
  }
}

} // namespace imgeo::testing
