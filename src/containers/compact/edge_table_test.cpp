#include "containers/compact/edge_table.h"

#include "containers/compact/connectivity.h"

#include <gtest/gtest.h>
#include <vector>

namespace imgeo::compact {
namespace {

using Corners = std::vector<std::uint32_t>;

/// The corner at the start of the edge that the table finds; `none` if it finds none.
std::uint32_t cornerOf(EdgeTable& table, std::uint32_t from, std::uint32_t to) {
  const EdgeTable::Edge* edge = table.find(from, to);
  return edge ? edge->corner : none;
}

TEST(EdgeTable, FindsEveryEdgeUntilItsTriangleIsTaken) {
  Corners corners;
  const std::uint32_t count = 100; // around vertex 0
  for (std::uint32_t i = 0; i < count; ++i)
    corners.insert(corners.end(), {0, 1 + i, 1 + (i + 1) % count});
  EdgeTable table(corners, count + 1);
  for (std::uint32_t corner = 0; corner < corners.size(); ++corner) {
    const std::uint32_t from = corners[corner], to = corners[corner - corner % 3 + (corner + 1) % 3];
    EXPECT_EQ(cornerOf(table, from, to), corner);
    if (from == 0)
      continue;
    table.take(corner / 3);
    EXPECT_EQ(cornerOf(table, from, to), none);
    if (to != 0) {
      EXPECT_EQ(cornerOf(table, to, from), none) << "the opposite edge";
    }
    table = EdgeTable(corners, count + 1);
  }
}

TEST(EdgeTable, FindsTheTrianglesOfOneEdgeInSourceOrder) {
  for (const std::uint32_t count : {2u, 7u, 50'000u}) {
    Corners corners;
    for (std::uint32_t i = 0; i < count; ++i)
      corners.insert(corners.end(), {0, 1, 2 + i});
    EdgeTable table(corners, count + 2);
    for (std::uint32_t i = 0; i < count; ++i) {
      ASSERT_EQ(cornerOf(table, 0, 1), 3 * i);
      ASSERT_EQ(table.find(0, 1)->third, 2 + i);
      table.take(i);
    }
    EXPECT_EQ(cornerOf(table, 0, 1), none);
  }
}

TEST(EdgeTable, LeavesOutTrianglesWithEqualCorners) {
  const Corners corners{0, 0, 1, 1, 2, 1, 2, 0, 0};
  EdgeTable table(corners, 3);
  for (std::uint32_t from = 0; from < 3; ++from)
    for (std::uint32_t to = 0; to < 3; ++to)
      EXPECT_EQ(cornerOf(table, from, to), none);
}

} // namespace
} // namespace imgeo::compact
