#include "containers/compact/range_encoder.h"

#include <cmath>

namespace imgeo::compact {

const CostMeter::Costs& CostMeter::costsOfProbabilities() {
  static const Costs costs = [] {
    Costs table{};
    for (std::size_t i = 0; i < table.size(); ++i)
      table[i] = static_cast<float>(12 - std::log2(static_cast<double>(i) + 0.5));
    return table;
  }();
  return costs;
}

} // namespace imgeo::compact
