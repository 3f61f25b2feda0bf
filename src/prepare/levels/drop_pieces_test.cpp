#include "prepare/levels/drop_pieces.h"

#include <gtest/gtest.h>
#include <numeric>

namespace imgeo {
namespace {

/// Triangles of their own positions, in a row; the legs of triangle n are `sizes[n]` long.
SimplifiedTriangles rowOf(const std::vector<std::uint32_t>& sizes) {
  SimplifiedTriangles row;
  for (std::uint32_t n = 0; n < sizes.size(); ++n) {
    row.positions.insert(row.positions.end(), {{1000 * n, 0, 0}, {1000 * n + sizes[n], 0, 0}, {1000 * n, sizes[n], 0}});
    row.triangles.push_back(n);
  }
  row.corners.resize(row.positions.size());
  std::iota(row.corners.begin(), row.corners.end(), 0u);
  row.vertexOfInput = row.corners;
  return row;
}

std::vector<std::uint32_t> keptOf(const std::vector<std::uint32_t>& sizes, std::size_t triangleCount,
                                  const std::vector<std::uint32_t>& fixedTriangles = {}) {
  SimplifiedTriangles row = rowOf(sizes);
  const SimplifiedTriangles before = row;
  std::vector<bool> isFixed(row.positions.size());
  for (const std::uint32_t triangle : fixedTriangles)
    isFixed[3 * triangle + 1] = true;
  dropPieces(row, isFixed, triangleCount);
  EXPECT_EQ(row.corners.size(), 3 * row.triangles.size());
  EXPECT_EQ(row.positions.size(), isFixed.size());
  for (std::size_t n = 0; n < row.triangles.size(); ++n)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t input = before.corners[3 * row.triangles[n] + i], position = row.corners[3 * n + i];
      EXPECT_EQ(row.positions[position], before.positions[input]);
      EXPECT_EQ(row.vertexOfInput[input], position);
    }
  for (std::size_t input = 0; input < before.positions.size(); ++input) {
    const bool isKept = std::ranges::find(row.triangles, input / 3) != row.triangles.end();
    EXPECT_EQ(row.vertexOfInput[input] != SimplifiedTriangles::none, isKept);
  }
  return row.triangles;
}

using Indices = std::vector<std::uint32_t>;

TEST(DroppedPieces, AreTheSmallestOnes) {
  EXPECT_EQ(keptOf({400, 3, 90, 400, 7, 200}, 3), (Indices{0, 3, 5}));
}

TEST(DroppedPieces, AreSpreadEvenlyAmongPiecesOfOneSize) {
  const Indices kept = keptOf(Indices(16, 100), 4);
  ASSERT_EQ(kept.size(), 4u);
  for (std::size_t n = 1; n < kept.size(); ++n)
    EXPECT_LE(kept[n] - kept[n - 1], 6u);
}

TEST(DroppedPieces, HaveNoFixedPosition) {
  EXPECT_EQ(keptOf({400, 3, 90, 400, 7, 200}, 1, {1, 4}).size(), 3u); // these, and the largest
}

TEST(DroppedPieces, AreCountedByTheirTriangles) {
  EXPECT_EQ(countPieces(5, Indices{}), 0u);
  EXPECT_EQ(countPieces(7, Indices{0, 1, 2, 2, 1, 3}), 1u);
  EXPECT_EQ(countPieces(7, Indices{0, 1, 2, 4, 5, 6}), 2u);
}

TEST(DroppedPieces, AreNoneWhereNoneNeedToBe) {
  EXPECT_EQ(keptOf({5, 6, 7}, 3), (Indices{0, 1, 2}));
  EXPECT_EQ(keptOf({5, 6, 7}, 0), (Indices{2})) << "something remains";
}

} // namespace
} // namespace imgeo
