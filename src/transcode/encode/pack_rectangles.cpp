#include "transcode/encode/pack_rectangles.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace imgeo {

namespace {

/// How many widths are tried.
constexpr int widthCount = 16;

/// The upper edge of what has been arranged in an image of a width: runs of columns of one height.
class Skyline {
public:
  explicit Skyline(std::uint32_t width) : width_(width), runs_{{0, 0}} {}

  /// Adds a rectangle, which is no wider, where its lower edge is lowest. Returns its first column and row.
  std::pair<std::uint32_t, std::uint32_t> add(RasterSize rectangle) {
    std::size_t best = 0;
    std::uint32_t row = UINT32_MAX;
    for (std::size_t first = 0; first < runs_.size() && runs_[first].column + rectangle.width <= width_; ++first)
      if (const std::uint32_t above = rowOver(first, rectangle.width, row); above < row)
        best = first, row = above;
    const std::uint32_t column = runs_[best].column, end = column + rectangle.width;
    std::size_t last = best; // of the runs below
    while (last + 1 < runs_.size() && runs_[last + 1].column < end)
      ++last;
    const std::uint32_t nextColumn = last + 1 < runs_.size() ? runs_[last + 1].column : width_;
    const Run rest{end, runs_[last].row};
    runs_[best] = {column, row + rectangle.height};
    runs_.erase(runs_.begin() + static_cast<std::ptrdiff_t>(best) + 1,
                runs_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    if (end < nextColumn)
      runs_.insert(runs_.begin() + static_cast<std::ptrdiff_t>(best) + 1, rest);
    return {column, row};
  }

private:
  struct Run {
    std::uint32_t column, row; ///< the first column; the first row that is free
  };

  /// The first row that is free in all columns from the beginning of a run on, or `limit` if it is not below.
  std::uint32_t rowOver(std::size_t first, std::uint32_t width, std::uint32_t limit) const {
    std::uint32_t row = 0;
    for (std::size_t run = first; run < runs_.size() && runs_[run].column < runs_[first].column + width; ++run)
      if (row = std::max(row, runs_[run].row); row >= limit)
        return limit;
    return row;
  }

  std::uint32_t width_;
  std::vector<Run> runs_; ///< from the first column to the last
};

PackedRectangles onSkyline(std::span<const RasterSize> rectangles, std::span<const std::size_t> order,
                           std::uint32_t width) {
  PackedRectangles packed;
  packed.corners.resize(rectangles.size());
  Skyline skyline(width);
  for (const std::size_t i : order) {
    packed.corners[i] = skyline.add(rectangles[i]);
    packed.size.width = std::max(packed.size.width, packed.corners[i].first + rectangles[i].width);
    packed.size.height = std::max(packed.size.height, packed.corners[i].second + rectangles[i].height);
  }
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
    PackedRectangles packed = onSkyline(rectangles, order, static_cast<std::uint32_t>(width));
    if (packed.size.height <= maxEdge && (!best || areaOf(packed.size) < areaOf(best->size)))
      best = std::move(packed);
  }
  return best;
}

} // namespace imgeo
