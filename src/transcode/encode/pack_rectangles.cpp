#include "transcode/encode/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace imgeo {

namespace {

/// How many widths are tried.
constexpr int widthCount = 16;

/// Fills shelves of a width from left to right.
PackedRectangles onShelves(std::span<const RasterSize> rectangles, std::span<const std::size_t> order,
                           std::uint32_t width) {
  PackedRectangles packed;
  packed.corners.resize(rectangles.size());
  std::uint32_t column = 0, row = 0, height = 0;
  for (const std::size_t i : order) {
    if (column + rectangles[i].width > width) {
      row += height;
      column = height = 0;
    }
    packed.corners[i] = {column, row};
    column += rectangles[i].width;
    height = std::max(height, rectangles[i].height);
    packed.size.width = std::max(packed.size.width, column);
  }
  packed.size.height = row + height;
  return packed;
}

std::uint64_t areaOf(RasterSize size) {
  return std::uint64_t{size.width} * size.height;
}

} // namespace

std::optional<PackedRectangles> packRectangles(std::span<const RasterSize> rectangles, std::uint32_t maxEdge) {
  std::vector<std::size_t> order(rectangles.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(rectangles[a].height, rectangles[a].width) > std::pair(rectangles[b].height, rectangles[b].width);
  });
  std::uint64_t area = 0;
  std::uint32_t widest = 0;
  for (const RasterSize& rectangle : rectangles) {
    area += areaOf(rectangle);
    widest = std::max(widest, rectangle.width);
  }
  std::optional<PackedRectangles> best;
  for (int n = 0; n < widthCount; ++n) {
    const double share = 0.7 + 0.1 * n; // of the edge of a square without gaps
    const double width = std::max(std::ceil(share * std::sqrt(static_cast<double>(area))), double(widest));
    if (width > maxEdge)
      break;
    PackedRectangles packed = onShelves(rectangles, order, static_cast<std::uint32_t>(width));
    if (packed.size.height <= maxEdge && (!best || areaOf(packed.size) < areaOf(best->size)))
      best = std::move(packed);
  }
  return best;
}

} // namespace imgeo
