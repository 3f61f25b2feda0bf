#include "prepare/d_ary_heap.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <random>

namespace imgeo {
namespace {

struct Number {
  unsigned value;
  bool isBefore(const Number& other) const { return value < other.value; }
};

TEST(DaryHeap, PopsTheFirstOfItsItems) {
  std::mt19937 random(1);
  DaryHeap<Number> heap;
  std::vector<unsigned> expected; // in descending order
  for (int i = 0; i < 5000; ++i) {
    // The heap grows and is emptied now and then.
    const bool isFilling = i / 250 % 4 != 3;
    if (isFilling || heap.empty()) {
      const auto value = static_cast<unsigned>(random() % 1000);
      heap.push({value});
      expected.insert(std::ranges::lower_bound(expected, value, std::greater<>()), value);
    }
    if (!isFilling || random() % 3 == 0) {
      ASSERT_EQ(heap.top().value, expected.back());
      heap.pop();
      expected.pop_back();
    }
    ASSERT_EQ(heap.empty(), expected.empty());
  }
}

} // namespace
} // namespace imgeo
