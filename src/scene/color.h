#pragma once
// The sRGB transfer function (IEC 61966-2-1) and its inverse, for values 0..1.

#include <cmath>

namespace imgeo {

inline double srgbOfLinear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

inline double linearOfSrgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

} // namespace imgeo
