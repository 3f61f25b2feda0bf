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
    const std::uint64_t hash = mixHash(mixHash(position.x, position.y), position.z);
    const std::uint32_t index =
        table_.findOrInsert(hash, next, [&](std::uint32_t i) { return positions[i] == position; });
    if (index == next)
      positions.push_back(position);
    return index;
  }

  std::vector<Vec3u> positions;

private:
  IndexHashTable table_;
};

} // namespace imgeo
