#pragma once
// Numbers lattice points.

#include "base/vec.h"
#include "prepare/index_hash_table.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace imgeo {

/// Collects distinct positions in the order of their first occurrence.
class PositionTable {
public:
  explicit PositionTable(std::size_t capacity) : table_(capacity) { positions.reserve(capacity); }

  std::uint32_t indexOf(const Vec3u& position) {
    const auto next = static_cast<std::uint32_t>(positions.size());
    const std::uint32_t index =
        table_.findOrInsert(hashOf(position), next, [&](std::uint32_t i) { return positions[i] == position; });
    if (index == next)
      positions.push_back(position);
    return index;
  }

  /// Prefetches the slot of a position that will be looked up soon.
  void prefetch(const Vec3u& position) const { table_.prefetch(hashOf(position)); }

  std::vector<Vec3u> positions;

private:
  static std::uint64_t hashOf(const Vec3u& position) { return mixHash(mixHash(position.x, position.y), position.z); }

  IndexHashTable table_;
};

} // namespace imgeo
