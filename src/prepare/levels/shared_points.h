#pragma once
// Finds the points that several groups of a level have, where nothing is simplified.

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace imgeo {

class SharedPoints {
public:
  explicit SharedPoints(std::size_t pointCount) : groups_(pointCount, none), isShared_(pointCount) {}

  void add(std::uint32_t point, std::uint32_t group) {
    if (groups_[point] == none)
      groups_[point] = group;
    else if (groups_[point] != group)
      isShared_[point] = true;
  }

  /// By point: whether several groups have it.
  std::vector<bool> take() { return std::move(isShared_); }

private:
  static constexpr std::uint32_t none = UINT32_MAX;

  std::vector<std::uint32_t> groups_; ///< by point: the first group that has it
  std::vector<bool> isShared_;
};

} // namespace imgeo
