#include "containers/compact/range_encoder.h"

#include <array>
#include <cmath>

namespace imgeo::compact {

float CostMeter::costOf(std::uint32_t probability) {
  static const std::array<float, 4096> costs = [] {
    std::array<float, 4096> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(12 - std::log2(static_cast<double>(i) + 0.5));
    return table;
  }();
  return costs[std::min(probability >> 4, 4095u)];
}

} // namespace imgeo::compact
