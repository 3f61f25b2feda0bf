#pragma once
// A hash table of indices into arrays that the caller keeps. It has no nodes, as std::unordered_map has, so it takes
// less memory and time.

#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <vector>

namespace imgeo {

/// Mixes one more word into a hash (the multiply-and-fold step of wyhash).
inline std::uint64_t mixHash(std::uint64_t hash, std::uint64_t word) {
  const auto product = static_cast<unsigned __int128>(hash ^ word ^ 0x9e3779b97f4a7c15u) * 0xa0761d6478bd642fu;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}

/// Open addressing with linear probing, at most half full.
class IndexHashTable {
public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// Holds at most `capacity` indices.
  explicit IndexHashTable(std::size_t capacity) : slots_(std::bit_ceil(2 * capacity + 1), none) {}

  /// Returns the index in the table for which `equals` is true; without such an index inserts and returns `index`.
  template <typename Equals> std::uint32_t findOrInsert(std::uint64_t hash, std::uint32_t index, Equals equals) {
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t at = hash & mask;; at = (at + 1) & mask) {
      if (slots_[at] == none)
        return slots_[at] = index;
      if (equals(slots_[at]))
        return slots_[at];
    }
  }

  /// Prefetches the slot of a hash that will be looked up soon.
  void prefetch(std::uint64_t hash) const { __builtin_prefetch(&slots_[hash & (slots_.size() - 1)], 1); }

private:
  std::vector<std::uint32_t> slots_;
};

} // namespace imgeo
