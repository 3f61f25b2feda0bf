#include "prepare/grid_parts.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo {
namespace {

TEST(GridParts, CoverEveryCellOnceAndShareTheirBorders) {
  for (const std::uint32_t columns : {2u, 16u, 17u, 31u, 32u, 47u})
    for (const std::uint32_t rows : {2u, 33u}) {
      constexpr std::uint32_t largest = 16;
      std::vector<int> covered(std::size_t{columns - 1} * (rows - 1), 0);
      const std::vector<GridPart> parts = gridParts({columns, rows}, largest);
      for (const auto& [origin, size] : parts) {
        EXPECT_TRUE(size.x >= 2 && size.y >= 2 && size.x <= largest && size.y <= largest);
        for (std::uint32_t row = origin.y; row + 1 < origin.y + size.y; ++row)
          for (std::uint32_t column = origin.x; column + 1 < origin.x + size.x; ++column)
            ++covered.at(std::size_t{row} * (columns - 1) + column);
      }
      EXPECT_TRUE(std::ranges::all_of(covered, [](int count) { return count == 1; })) << columns << " x " << rows;
      EXPECT_EQ(parts.size(), ((columns - 1 + 14) / 15) * ((rows - 1 + 14) / 15));
    }
}

TEST(GridParts, HaveTheirVerticesRowByRow) {
  EXPECT_EQ(verticesOf({{2, 1}, {3, 2}}, 6), (std::vector<std::uint32_t>{8, 9, 10, 14, 15, 16}));
}

} // namespace
} // namespace imgeo
