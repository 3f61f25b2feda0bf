#pragma once
// The shape of the tree of a cloud's groups: how many levels there are, and how many children each group has.

#include <cstdint>
#include <vector>

namespace imgeo {

/// The children of a group are at most so many.
inline constexpr std::uint64_t maxPointChildren = 4;

/// The groups of level 0 of so many points, all of about the same size.
constexpr std::uint64_t pointGroupCount(std::uint64_t points, std::uint32_t groupPoints) {
  return (points + groupPoints - 1) / groupPoints;
}

/// The level on which so many groups of level 0 become one, at least 1 of them.
constexpr std::uint32_t pointTreeHeight(std::uint64_t groupCount) {
  std::uint32_t height = 0;
  for (std::uint64_t capacity = 1; capacity < groupCount; capacity *= maxPointChildren)
    ++height;
  return height;
}

/// The groups of level 0 that a group of a level has at most.
constexpr std::uint64_t pointTreeCapacity(std::uint32_t level) {
  return std::uint64_t{1} << 2 * level;
}

/// Numbers of children: by level from one above the lowest up, by group.
using ChildCounts = std::vector<std::vector<std::uint32_t>>;

/// The groups above so many, of which neighbours follow one another, at least 1 of them: up to a level of one group.
/// Groups have two to four children.
ChildCounts pointTreeAbove(std::uint64_t groupCount);

} // namespace imgeo
