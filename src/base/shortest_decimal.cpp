#include "base/shortest_decimal.h"

#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace imgeo {

double shortestWithin(double value, double tolerance) {
  if (std::abs(value) <= tolerance)
    return 0;
  for (int decimals = 0; decimals < 16; ++decimals) {
    const std::string text = fmt::format("{:.{}e}", value, decimals);
    double shorter = value;
    std::from_chars(text.data(), text.data() + text.size(), shorter);
    if (std::abs(shorter - value) <= tolerance)
      return shorter;
  }
  return value;
}

} // namespace imgeo
