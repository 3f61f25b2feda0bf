#include "base/parallel.h"
#include "containers/compact/starts.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace imgeo::compact {
namespace {

constexpr std::uint32_t side = 12;

/// A square of side * side vertices, in two triangles a cell.
std::vector<std::uint32_t> square() {
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t y = 0; y + 1 < side; ++y)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = y * side + x, b = a + 1, c = a + side, d = c + 1;
      vertices.insert(vertices.end(), {a, b, d, a, d, c});
    }
  return vertices;
}

std::vector<std::uint32_t> startsOf(const std::vector<std::uint32_t>& vertices, const Search& search) {
  std::vector<std::uint32_t> starts;
  appendStarts(starts, vertices, *std::ranges::max_element(vertices) + 1, search);
  return starts;
}

TEST(Starts, AreSpreadFirstWithoutThoseOfTheEffortBefore) {
  EXPECT_EQ(startsOf(square(), {2, 0, 0, 0}), (std::vector<std::uint32_t>{0, 121}));
  EXPECT_EQ(startsOf(square(), {4, 2, 0, 0}), (std::vector<std::uint32_t>{60, 181}));
}

TEST(Starts, ThatPromiseFewBytesAreOthersThanThoseSpread) {
  std::vector<std::uint32_t> starts = startsOf(square(), {8, 0, 32, 3});
  ASSERT_EQ(starts.size(), 11u);
  std::ranges::sort(starts);
  EXPECT_TRUE(std::ranges::adjacent_find(starts) == starts.end());
  EXPECT_LT(starts.back(), square().size() / 3);
}

TEST(Starts, AreTheSameForAnyNumberOfThreads) {
  const std::vector<std::uint32_t> starts = startsOf(square(), {8, 0, 64, 5});
  limitThreads(1);
  EXPECT_EQ(startsOf(square(), {8, 0, 64, 5}), starts);
  limitThreads(0);
}

TEST(Starts, OfASingleTriangleAreThatTriangle) {
  EXPECT_EQ(startsOf({0, 1, 2}, {2, 0, 16, 1}), (std::vector<std::uint32_t>{0, 0, 0}));
}

} // namespace
} // namespace imgeo::compact
