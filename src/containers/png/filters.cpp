#include "containers/png/filters.h"

#include <algorithm>
#include <cstdlib>

namespace imgeo {

namespace {

/// Paeth's predictor: the neighbour nearest to left + up - upLeft, ties in that order.
std::uint8_t paeth(int left, int up, int upLeft) {
  const int toLeft = std::abs(up - upLeft), toUp = std::abs(left - upLeft), toUpLeft = std::abs(left + up - 2 * upLeft);
  if (toLeft <= toUp && toLeft <= toUpLeft)
    return static_cast<std::uint8_t>(left);
  return static_cast<std::uint8_t>(toUp <= toUpLeft ? up : upLeft);
}

/// Calls back with the prediction function of a filter: from the bytes to the left, above, and above left.
template <typename Each> void withPredictor(RowFilter filter, Each each) {
  switch (filter) {
  case RowFilter::sub:
    return each([](int left, int, int) { return left; });
  case RowFilter::up:
    return each([](int, int up, int) { return up; });
  case RowFilter::average:
    return each([](int left, int up, int) { return (left + up) / 2; });
  case RowFilter::paeth:
    return each([](int left, int up, int upLeft) { return int{paeth(left, up, upLeft)}; });
  case RowFilter::none:
  case RowFilter::adaptive: // chosen row by row, so not the filter of a row
    break;
  }
  return each([](int, int, int) { return 0; });
}

/// Filters one row into `out`. `above` is the previous row, or null at the top. The first pixel, which has no left
/// neighbour, is handled separately, so that the rest is a plain loop.
void filterRow(RowFilter filter, const std::uint8_t* row, const std::uint8_t* above, std::size_t rowBytes,
               std::size_t pixelBytes, std::uint8_t* out) {
  withPredictor(filter, [&](auto predict) {
    for (std::size_t i = 0; i < pixelBytes; ++i)
      out[i] = static_cast<std::uint8_t>(row[i] - predict(0, above ? above[i] : 0, 0));
    if (above)
      for (std::size_t i = pixelBytes; i < rowBytes; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - predict(row[i - pixelBytes], above[i], above[i - pixelBytes]));
    else
      for (std::size_t i = pixelBytes; i < rowBytes; ++i)
        out[i] = static_cast<std::uint8_t>(row[i] - predict(row[i - pixelBytes], 0, 0));
  });
}

/// Reverses the filter of one row; `above` is zeros at the top.
void unfilterRow(RowFilter filter, const std::uint8_t* row, const std::uint8_t* above, std::size_t rowBytes,
                 std::size_t pixelBytes, std::uint8_t* out) {
  withPredictor(filter, [&](auto predict) {
    for (std::size_t i = 0; i < pixelBytes; ++i)
      out[i] = static_cast<std::uint8_t>(row[i] + predict(0, above[i], 0));
    for (std::size_t i = pixelBytes; i < rowBytes; ++i)
      out[i] = static_cast<std::uint8_t>(row[i] + predict(out[i - pixelBytes], above[i], above[i - pixelBytes]));
  });
}

std::uint64_t sumOfDifferences(const std::uint8_t* row, std::size_t rowBytes) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < rowBytes; ++i)
    sum += row[i] < 128 ? row[i] : 256u - row[i];
  return sum;
}

} // namespace

Bytes filterRows(const Image& image, RowFilter filter) {
  const std::size_t rowBytes = std::size_t{image.width} * image.channels;
  Bytes filtered(image.height * (rowBytes + 1)), trial(rowBytes);
  for (std::size_t y = 0; y < image.height; ++y) {
    const std::uint8_t* row = image.pixels.data() + y * rowBytes;
    const std::uint8_t* above = y > 0 ? row - rowBytes : nullptr;
    std::uint8_t* out = filtered.data() + y * (rowBytes + 1);
    if (filter != RowFilter::adaptive) {
      out[0] = static_cast<std::uint8_t>(filter);
      filterRow(filter, row, above, rowBytes, image.channels, out + 1);
      continue;
    }
    std::uint64_t smallest = UINT64_MAX;
    for (const RowFilter candidate :
         {RowFilter::none, RowFilter::sub, RowFilter::up, RowFilter::average, RowFilter::paeth}) {
      filterRow(candidate, row, above, rowBytes, image.channels, trial.data());
      const std::uint64_t sum = sumOfDifferences(trial.data(), rowBytes);
      if (sum >= smallest)
        continue;
      smallest = sum;
      out[0] = static_cast<std::uint8_t>(candidate);
      std::copy(trial.begin(), trial.end(), out + 1);
    }
  }
  return filtered;
}

bool unfilterRows(ByteSpan filtered, Image& image) {
  const std::size_t rowBytes = std::size_t{image.width} * image.channels;
  image.pixels.resize(rowBytes * image.height);
  const Bytes zeros(rowBytes);
  const std::uint8_t* above = zeros.data();
  for (std::size_t y = 0; y < image.height; ++y) {
    const std::uint8_t* row = &filtered[y * (rowBytes + 1)];
    std::uint8_t* out = &image.pixels[y * rowBytes];
    if (row[0] > static_cast<std::uint8_t>(RowFilter::paeth))
      return false;
    unfilterRow(static_cast<RowFilter>(row[0]), row + 1, above, rowBytes, image.channels, out);
    above = out;
  }
  return true;
}

} // namespace imgeo
