#include "transcode/encode/chip_image.h"

#include "transcode/encode/chip_limits.h"
#include "transcode/encode/linear_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace imgeo {

ChipImage::ChipImage(RasterSize size, std::uint32_t level, const ChipSource& source) : level_(level), source_(source) {
  image_.width = size.width, image_.height = size.height;
  image_.pixels.resize(std::size_t{4} * size.width * size.height);
  for (std::size_t alpha = 3; alpha < image_.pixels.size(); alpha += 4)
    image_.pixels[alpha] = 255;
}

void ChipImage::draw(const ChipPiece& piece, std::uint32_t column, std::uint32_t row) {
  const RasterSize size = chipSize(piece.rect);
  isDrawn_.assign(std::size_t{size.width} * size.height, false);
  const ChartMask& chart = source_.charts[piece.chart];
  if (!drawTexels(piece.rect, size.width, column, row, [&](auto x, auto y) { return chart.has(x, y); })) {
    if (source_.projections.empty())
      drawTexels(piece.rect, size.width, column, row, [](auto, auto) { return true; });
    else
      drawNearest(piece, size.width, column, row);
  }
  fillOutwards(size, column, row);
}

/// Returns whether there is a texel that `isCovered` has.
template <typename IsCovered>
bool ChipImage::drawTexels(const TexelRect& rect, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row,
                           IsCovered isCovered) {
  bool isAny = false;
  for (std::uint32_t y = 0; y < rect.height; ++y)
    for (std::uint32_t x = 0; x < rect.width; ++x) {
      if (!drawTexel(rect.left + x, rect.top + y, pixel(column + chipGutter + x, row + chipGutter + y), isCovered))
        continue;
      isDrawn_[std::size_t{y + chipGutter} * chipWidth + chipGutter + x] = true;
      isAny = true;
    }
  return isAny;
}

/// Draws the texel in the middle of a piece that is beside its chart, with the nearest that the chart covers.
void ChipImage::drawNearest(const ChipPiece& piece, std::uint32_t chipWidth, std::uint32_t column, std::uint32_t row) {
  const ChartMask& chart = source_.charts[piece.chart];
  const double edge = std::ldexp(1, int(level_));
  const TexelPoint middle{(piece.rect.left + piece.rect.width / 2.0) * edge,
                          (piece.rect.top + piece.rect.height / 2.0) * edge};
  double smallest = std::numeric_limits<double>::infinity();
  const std::uint8_t* nearest = nullptr;
  for (std::uint32_t y = chart.rect().top; y < chart.rect().top + chart.rect().height; ++y)
    for (std::uint32_t x = chart.rect().left; x < chart.rect().left + chart.rect().width; ++x)
      if (const double distance = std::hypot(x + 0.5 - middle.x, y + 0.5 - middle.y);
          distance < smallest && chart.has(x, y)) {
        smallest = distance;
        nearest = &source_.image.pixels[4 * (std::size_t{y} * source_.image.width + x)];
      }
  if (!nearest)
    return;
  const std::uint32_t x = chipGutter + piece.rect.width / 2, y = chipGutter + piece.rect.height / 2;
  std::copy_n(nearest, 4, pixel(column + x, row + y));
  isDrawn_[std::size_t{y} * chipWidth + x] = true;
}

/// Sets the mean of the covered texels of the source that a texel of the level stands for, if there are any.
template <typename IsCovered>
bool ChipImage::drawTexel(std::uint32_t x, std::uint32_t y, std::uint8_t* pixel, IsCovered isCovered) const {
  const Raster& from = source_.image;
  const std::uint32_t edge = 1u << level_;
  const std::uint32_t right = std::min((x + 1) * edge, from.width), bottom = std::min((y + 1) * edge, from.height);
  PixelSum sum;
  const std::uint8_t* last = nullptr;
  for (std::uint32_t v = y * edge; v < bottom; ++v)
    for (std::uint32_t u = x * edge; u < right; ++u)
      if (isCovered(u, v)) {
        last = &from.pixels[4 * (std::size_t{v} * from.width + u)];
        sum.add(last);
      }
  if (sum.weight == 1)
    std::copy_n(last, 4, pixel);
  else if (sum.weight > 1)
    sum.storeMean(pixel);
  return sum.weight > 0;
}

/// Gives the other texels of a chip the mean of their neighbours that have been drawn, from the nearest on.
void ChipImage::fillOutwards(RasterSize size, std::uint32_t column, std::uint32_t row) {
  using Texel = std::pair<std::uint32_t, std::uint32_t>;
  const auto forNeighbours = [&](Texel at, const auto& visit) {
    for (const auto& [dx, dy] : {std::pair(-1, 0), {1, 0}, {0, -1}, {0, 1}}) {
      const std::uint32_t x = at.first + static_cast<std::uint32_t>(dx), y = at.second + static_cast<std::uint32_t>(dy);
      if (x < size.width && y < size.height) // also where a sum has wrapped
        visit(Texel{x, y});
    }
  };
  const auto index = [&](Texel at) { return std::size_t{at.second} * size.width + at.first; };
  std::vector<Texel> front;
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x)
      if (isDrawn_[index({x, y})])
        front.emplace_back(x, y);
  std::vector<bool> isWaiting(isDrawn_.size());
  while (!front.empty()) {
    std::vector<Texel> next;
    for (const Texel& at : front)
      forNeighbours(at, [&](Texel neighbour) {
        if (!isDrawn_[index(neighbour)] && !isWaiting[index(neighbour)]) {
          isWaiting[index(neighbour)] = true;
          next.push_back(neighbour);
        }
      });
    for (const Texel& at : next) {
      PixelSum sum;
      forNeighbours(at, [&](Texel neighbour) {
        if (isDrawn_[index(neighbour)])
          sum.add(pixel(column + neighbour.first, row + neighbour.second));
      });
      sum.storeMean(pixel(column + at.first, row + at.second));
    }
    for (const Texel& at : next)
      isDrawn_[index(at)] = true;
    front = std::move(next);
  }
}

} // namespace imgeo
