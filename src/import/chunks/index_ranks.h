#pragma once
// The vertices that a piece of a file names.

#include <algorithm>
#include <cstdint>
#include <vector>

namespace imgeo {

/// Numbers indices of vertices from 0, in ascending order.
class IndexRanks {
public:
  explicit IndexRanks(std::vector<std::uint32_t> indices) : sorted_(std::move(indices)) {
    if (sorted_.empty())
      return;
    const auto [low, high] = std::ranges::minmax_element(sorted_);
    const std::uint64_t range = std::uint64_t{*high} - *low + 1;
    first_ = *low;
    if (range > 8 * sorted_.size()) { // vertices from all over the file
      std::ranges::sort(sorted_);
      sorted_.erase(std::unique(sorted_.begin(), sorted_.end()), sorted_.end());
      return;
    }
    std::vector<bool> isUsed(range);
    for (const std::uint32_t index : sorted_)
      isUsed[index - first_] = true;
    sorted_.clear();
    ranks_.resize(range);
    for (std::uint64_t i = 0; i < range; ++i)
      if (isUsed[i]) {
        ranks_[i] = static_cast<std::uint32_t>(sorted_.size());
        sorted_.push_back(first_ + static_cast<std::uint32_t>(i));
      }
  }

  std::uint32_t of(std::uint32_t index) const {
    return ranks_.empty() ? static_cast<std::uint32_t>(std::ranges::lower_bound(sorted_, index) - sorted_.begin())
                          : ranks_[index - first_];
  }
  const std::vector<std::uint32_t>& indices() const { return sorted_; }

private:
  std::vector<std::uint32_t> sorted_, ranks_;
  std::uint32_t first_ = 0;
};

} // namespace imgeo
