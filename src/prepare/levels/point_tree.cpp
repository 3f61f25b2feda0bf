#include "prepare/levels/point_tree.h"

#include <algorithm>

namespace imgeo {

namespace {

/// Halves a number until no part is more than `capacity`, but once at least.
void halve(std::uint64_t count, std::uint64_t capacity, std::vector<std::uint64_t>& parts) {
  for (const std::uint64_t half : {count / 2, count - count / 2})
    if (half > capacity)
      halve(half, capacity, parts);
    else
      parts.push_back(half);
}

} // namespace

ChildCounts pointTreeAbove(std::uint64_t groupCount) {
  ChildCounts counts;
  std::vector<std::uint64_t> nodes{groupCount};
  for (std::uint32_t level = pointTreeHeight(groupCount); level-- > 0;) {
    std::vector<std::uint64_t> below;
    std::vector<std::uint32_t>& ofLevel = counts.emplace_back();
    for (const std::uint64_t node : nodes) {
      const std::size_t before = below.size();
      if (node > 1)
        halve(node, pointTreeCapacity(level), below);
      else
        below.push_back(node);
      ofLevel.push_back(static_cast<std::uint32_t>(below.size() - before));
    }
    nodes = std::move(below);
  }
  std::ranges::reverse(counts);
  return counts;
}

} // namespace imgeo
