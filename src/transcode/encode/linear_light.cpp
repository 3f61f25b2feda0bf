#include "transcode/encode/linear_light.h"

#include <algorithm>
#include <cmath>

namespace imgeo {

namespace {

struct LinearLight {
  std::array<float, 256> ofByte{};
  std::array<std::uint8_t, 65536> byteOf{};

  LinearLight() {
    for (std::size_t byte = 0; byte < ofByte.size(); ++byte) {
      const double encoded = double(byte) / 255;
      ofByte[byte] =
          static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
    }
    for (std::size_t i = 0; i < byteOf.size(); ++i) {
      const double linear = double(i) / 65535;
      const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
      byteOf[i] = static_cast<std::uint8_t>(std::lround(std::clamp(encoded, 0.0, 1.0) * 255));
    }
  }

  std::uint8_t byteOfLinear(double linear) const {
    return byteOf[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0, 1.0) * 65535))];
  }
};

const LinearLight& linearLight() {
  static const LinearLight tables;
  return tables;
}

} // namespace

void PixelSum::add(const std::uint8_t* pixel, double weightOfPixel) {
  const double opacity = weightOfPixel * (pixel[3] / 255.0);
  for (std::size_t c = 0; c < 3; ++c)
    light[c] += opacity * linearLight().ofByte[pixel[c]];
  alpha += opacity;
  weight += weightOfPixel;
}

void PixelSum::storeMean(std::uint8_t* pixel) const {
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] = alpha > 0 ? linearLight().byteOfLinear(light[c] / alpha) : std::uint8_t{0};
  pixel[3] = static_cast<std::uint8_t>(std::lround(255 * alpha / weight));
}

} // namespace imgeo
