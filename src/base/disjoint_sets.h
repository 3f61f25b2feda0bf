#pragma once
// Sets of indices that are merged two at a time: a union-find structure with path halving.

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace imgeo {

class DisjointSets {
public:
  /// Each index from 0 to count - 1 is a set of its own.
  explicit DisjointSets(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0u); }

  /// The smallest index of the set.
  std::uint32_t find(std::uint32_t index) {
    while (parents_[index] != index)
      index = parents_[index] = parents_[parents_[index]];
    return index;
  }
  void merge(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parents_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parents_;
};

} // namespace imgeo
