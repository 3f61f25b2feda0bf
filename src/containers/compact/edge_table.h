#pragma once
// The triangles at a directed edge that have not been taken yet, in constant time
// however many share it.

#include "prepare/index_table.h"

#include <span>
#include <vector>

namespace imgeo::compact {

class EdgeTable {
public:
  static constexpr std::uint32_t none = UINT32_MAX;

  /// `vertices` are corners of triangles and outlive the table. Triangles with two
  /// equal corners have no edges here.
  explicit EdgeTable(std::span<const std::uint32_t> vertices)
      : vertices_(vertices), table_(vertices.size()), heads_(vertices.size(), none),
        following_(vertices.size(), none), taken_(vertices.size() / 3) {
    // From the last to the first, so that a list has the source's order.
    for (std::size_t triangle = taken_.size(); triangle-- > 0;) {
      const auto first = static_cast<std::uint32_t>(triangle * 3);
      const std::uint32_t a = vertices[first], b = vertices[first + 1], c = vertices[first + 2];
      if (a == b || b == c || c == a)
        continue;
      for (std::uint32_t corner = first; corner < first + 3; ++corner) {
        const std::uint32_t list =
            table_.findOrInsert(hashOf(corner), corner, [&](std::uint32_t i) { return isSame(i, corner); });
        following_[corner] = heads_[list];
        heads_[list] = corner;
      }
    }
  }

  /// The corner at `from` of a triangle, not taken yet, that has the edge from -> to; or none.
  std::uint32_t find(std::uint32_t from, std::uint32_t to) {
    const std::uint32_t list = table_.find(hashOf(from, to), [&](std::uint32_t i) {
      return vertices_[i] == from && vertices_[afterCorner(i)] == to;
    });
    if (list == IndexTable::none)
      return none;
    std::uint32_t& head = heads_[list];
    while (head != none && taken_[head / 3])
      head = following_[head];
    return head;
  }

  bool isTaken(std::uint32_t triangle) const { return taken_[triangle]; }
  void take(std::uint32_t triangle) { taken_[triangle] = true; }

private:
  static std::uint32_t afterCorner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  static std::uint64_t hashOf(std::uint32_t from, std::uint32_t to) {
    return mixHash(0, std::uint64_t{from} << 32 | to);
  }
  std::uint64_t hashOf(std::uint32_t corner) const {
    return hashOf(vertices_[corner], vertices_[afterCorner(corner)]);
  }
  bool isSame(std::uint32_t a, std::uint32_t b) const {
    return vertices_[a] == vertices_[b] && vertices_[afterCorner(a)] == vertices_[afterCorner(b)];
  }

  std::span<const std::uint32_t> vertices_;
  IndexTable table_;
  std::vector<std::uint32_t> heads_, following_; ///< lists of corners, one an edge
  std::vector<bool> taken_;
};

} // namespace imgeo::compact
