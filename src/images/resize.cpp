#include "images/resize.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace imgeo {

namespace {

using Pixel = std::array<float, 4>;

/// The sRGB transfer function (IEC 61966-2-1), 0 .. 1.
float linearOf(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}
float encodedOf(float linear) {
  return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

std::uint8_t byteOf(float fraction) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(fraction, 0.0f, 1.0f) * 255));
}

/// Converts pixels between bytes and numbers whose mean is meaningful.
class Averaging {
public:
  explicit Averaging(PixelContent content) : content_(content) {
    for (std::size_t byte = 0; byte < values_.size(); ++byte) {
      const float fraction = static_cast<float>(byte) / 255;
      values_[byte] = content == PixelContent::color        ? linearOf(fraction)
                      : content == PixelContent::directions ? 2 * fraction - 1
                                                            : fraction;
    }
  }

  Pixel numbersOf(const std::uint8_t* bytes) const {
    const float alpha = static_cast<float>(bytes[3]) / 255, weight = content_ == PixelContent::color ? alpha : 1;
    return {values_[bytes[0]] * weight, values_[bytes[1]] * weight, values_[bytes[2]] * weight, alpha};
  }

  void store(const Pixel& mean, std::uint8_t* bytes) const {
    const float weight = content_ == PixelContent::color ? mean[3] : 1;
    Pixel value{};
    for (std::size_t c = 0; c < 3 && weight > 0; ++c)
      value[c] = mean[c] / weight;
    if (content_ == PixelContent::directions) {
      const float length = std::hypot(value[0], value[1], value[2]);
      for (std::size_t c = 0; c < 3; ++c)
        value[c] = length > 0 ? value[c] / length : c == 2 ? 1.0f : 0.0f;
    }
    for (std::size_t c = 0; c < 3; ++c)
      bytes[c] = byteOf(content_ == PixelContent::color        ? encodedOf(value[c])
                        : content_ == PixelContent::directions ? value[c] / 2 + 0.5f
                                                               : value[c]);
    bytes[3] = byteOf(mean[3]);
  }

private:
  PixelContent content_;
  std::array<float, 256> values_{};
};

/// The source pixels that a pixel of the result covers along one axis, from `first` on, with their weights.
struct Coverage {
  std::size_t first = 0;
  std::vector<float> weights;
};

std::vector<Coverage> coverageOf(std::uint32_t sourceSize, std::uint32_t size) {
  std::vector<Coverage> coverage(size);
  const double step = static_cast<double>(sourceSize) / size;
  for (std::uint32_t i = 0; i < size; ++i) {
    const double begin = i * step, end = std::min<double>((i + 1) * step, sourceSize);
    coverage[i].first = static_cast<std::size_t>(begin);
    for (std::size_t at = coverage[i].first; static_cast<double>(at) < end; ++at) {
      const double from = std::max(begin, static_cast<double>(at)), until = std::min(end, static_cast<double>(at) + 1);
      coverage[i].weights.push_back(static_cast<float>((until - from) / step));
    }
  }
  return coverage;
}

/// Adds a source row, downscaled horizontally and weighted, to a row of means.
void addRow(const std::uint8_t* row, const std::vector<Coverage>& coverage, float weight, const Averaging& averaging,
            std::vector<Pixel>& means) {
  for (std::size_t x = 0; x < coverage.size(); ++x)
    for (std::size_t i = 0; i < coverage[x].weights.size(); ++i) {
      const Pixel numbers = averaging.numbersOf(row + 4 * (coverage[x].first + i));
      for (std::size_t c = 0; c < 4; ++c)
        means[x][c] += weight * coverage[x].weights[i] * numbers[c];
    }
}

} // namespace

RasterSize sizeWithin(RasterSize size, std::uint32_t maxEdge) {
  const std::uint32_t edge = std::max(size.width, size.height);
  if (edge <= maxEdge)
    return size;
  const auto scaled = [&](std::uint32_t length) {
    const double exact = static_cast<double>(length) * maxEdge / edge;
    return std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::lround(exact)));
  };
  return {scaled(size.width), scaled(size.height)};
}

Raster downscaled(const Raster& raster, RasterSize size, PixelContent content) {
  assert(size.width > 0 && size.width <= raster.width && size.height > 0 && size.height <= raster.height);
  const std::vector<Coverage> across = coverageOf(raster.width, size.width),
                              down = coverageOf(raster.height, size.height);
  const Averaging averaging(content);
  Raster smaller{size.width, size.height, Bytes(std::size_t{4} * size.width * size.height)};
  std::vector<Pixel> means(size.width);
  for (std::size_t y = 0; y < size.height; ++y) {
    std::ranges::fill(means, Pixel{});
    for (std::size_t i = 0; i < down[y].weights.size(); ++i)
      addRow(&raster.pixels[std::size_t{4} * raster.width * (down[y].first + i)], across, down[y].weights[i], averaging,
             means);
    for (std::size_t x = 0; x < size.width; ++x)
      averaging.store(means[x], &smaller.pixels[4 * (y * size.width + x)]);
  }
  return smaller;
}

} // namespace imgeo
