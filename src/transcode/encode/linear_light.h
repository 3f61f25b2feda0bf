#pragma once
// Means of sRGB colours in linear light (IEC 61966-2-1).

#include <array>
#include <cstdint>

namespace imgeo {

/// A sum of pixels, whose mean is one in linear light, weighed by alpha. Pixels are red, green, blue, alpha.
struct PixelSum {
  std::array<double, 3> light{};
  double alpha = 0, weight = 0;

  void add(const std::uint8_t* pixel, double weightOfPixel = 1);
  /// Stores the mean of a sum that has a weight.
  void storeMean(std::uint8_t* pixel) const;
};

} // namespace imgeo
