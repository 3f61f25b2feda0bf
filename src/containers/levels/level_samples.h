#pragma once
// For tests and vectors: indexes of levels, and payloads that readers must refuse.

#include "containers/levels/level_index.h"
#include "scene/testing.h"

#include <algorithm>
#include <string>
#include <vector>

namespace imgeo::testing {

struct LevelSample {
  std::string name;
  LevelIndex index;
};

/// An index with so many groups on each level, from the highest down. Each group has one to three parents near it.
inline LevelIndex levelIndexOf(const std::vector<std::uint32_t>& groupCounts, std::uint32_t bits,
                               std::uint32_t pageGroups, std::uint32_t seed, bool hasNestedSpheres = true) {
  Random random(seed);
  LevelIndex index;
  index.hasNestedSpheres = hasNestedSpheres;
  index.positionBits = bits;
  index.pageGroups = pageGroups;
  index.rootCount = groupCounts.front();
  std::vector<GroupBounds> bounds;
  const double extent = std::exp2(bits) - 1;
  std::size_t first = 0;
  for (std::size_t row = 0; row < groupCounts.size(); ++row) {
    const std::size_t above = first;
    first = index.groups.size();
    for (std::uint32_t i = 0; i < groupCounts[row]; ++i) {
      LevelGroup group;
      group.level = static_cast<std::uint8_t>(groupCounts.size() - 1 - row);
      group.triangles = 20000 + random.below(12769);
      group.vertices = group.triangles / 2 + random.below(300);
      group.bytes = 256 + group.triangles + random.below(9000);
      const double along = (i + 0.5) / groupCounts[row];
      bounds.push_back({{extent * along, extent * random.below(1000) / 1000, extent / 2},
                        extent / groupCounts[row],
                        std::exp2(2.0 * group.level + random.below(100) / 50.0)});
      for (std::uint32_t n = 0; row > 0 && n < 3; ++n) {
        const std::size_t parent =
            std::min<std::size_t>(first - 1, above + i * groupCounts[row - 1] / groupCounts[row] + random.below(2) * n);
        std::vector<std::uint32_t>& children = index.groups[parent].children;
        if (children.empty() || children.back() != first + i)
          children.push_back(static_cast<std::uint32_t>(first + i));
      }
      index.groups.push_back(std::move(group));
    }
  }
  setBounds(index, bounds);
  return index;
}

/// The indexes of vectors/levels-1.
inline std::vector<LevelSample> levelSamples() {
  LevelIndex unbounded = levelIndexOf({1, 3, 9}, 8, 1024, 4);
  unbounded.groups[0].sphere.radius = unboundedRadiusCode;
  LevelIndex points = levelIndexOf({1, 4, 14, 50}, 20, 24, 7);
  points.hasPoints = true;
  for (LevelGroup& group : points.groups)
    group.triangles = 0;
  LevelIndex chips = levelIndexOf({1, 4, 9}, 16, 8, 8);
  chips.hasChips = true;
  for (std::uint32_t i = 0; i < chips.groups.size(); ++i) {
    LevelGroup& group = chips.groups[i];
    group.chipColumns = 4 + 100 * i, group.chipRows = 2000 - 4 * i, group.chipBytes = 1 + 7777 * i;
  }
  return {{"one-group", levelIndexOf({1}, 12, 1024, 1)},
          {"two-levels", levelIndexOf({1, 4}, 16, 1024, 2)},
          {"several-roots", levelIndexOf({5, 9, 20}, 24, 16, 3)},
          {"unbounded", unbounded},
          {"five-levels", levelIndexOf({1, 4, 15, 60, 240}, 18, 100, 5)},
          {"points", points},
          {"chips", chips},
          {"own-spheres", levelIndexOf({1, 4, 15, 60}, 18, 30, 9, false)}};
}

} // namespace imgeo::testing
