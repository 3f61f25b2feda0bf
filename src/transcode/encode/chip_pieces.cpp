#include "transcode/encode/chip_pieces.h"

#include "transcode/encode/chip_limits.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace imgeo {

namespace {

/// A chip that covers this many times the texels of its triangles is divided, if that saves so much of them.
constexpr double maxRectShare = 1.1, maxDividedShare = 0.95;
constexpr std::size_t minDividedTriangles = 16;
/// It is divided at an end of one of so many parts of its triangles.
constexpr std::size_t dividedParts = 8;

std::uint32_t alignedUp(std::uint32_t edge) {
  return (edge + chipGutter - 1) / chipGutter * chipGutter;
}

double chipArea(RasterSize size) {
  return double(size.width) * size.height;
}

} // namespace

RasterSize chipSize(const TexelRect& rect) {
  return {alignedUp(rect.width + 2 * chipGutter), alignedUp(rect.height + 2 * chipGutter)};
}

ChipPieces::ChipPieces(const Patch& patch, std::size_t set, const ChipSource& source, std::uint32_t level)
    : patch_(patch), set_(set), width_(std::ldexp(source.image.width, -int(level))),
      height_(std::ldexp(source.image.height, -int(level))) {
  points_.reserve(patch.wedgeCount());
  for (std::uint32_t wedge = 0; wedge < patch.wedgeCount(); ++wedge)
    points_.push_back(pointOf(wedge, source));
}

std::vector<ChipPiece> ChipPieces::take() {
  std::map<std::uint32_t, std::vector<std::uint32_t>> byChart;
  for (std::uint32_t triangle = 0; triangle < patch_.elementCount(); ++triangle)
    byChart[chartOfWedge(patch_.corners[3 * std::size_t{triangle}])].push_back(triangle);
  for (auto& [chart, triangles] : byChart)
    add({chart, std::move(triangles), {}});
  return std::move(pieces_);
}

double ChipPieces::texelArea(std::uint32_t triangle) const {
  const auto [a, b, c] = pointsOf(triangle);
  return std::abs((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

std::array<TexelPoint, 3> ChipPieces::pointsOf(std::uint32_t triangle) const {
  const std::uint32_t* const corners = &patch_.corners[3 * std::size_t{triangle}];
  return {at(corners[0]), at(corners[1]), at(corners[2])};
}

TexelPoint ChipPieces::pointOf(std::uint32_t wedge, const ChipSource& source) const {
  if (source.projections.empty())
    return texelOf(patch_.texCoords[wedge], width_, height_);
  const TexelPoint whole =
      source.projections[chartOfWedge(wedge)].texelOf(patch_.positions[patch_.wedgePositions[wedge]]);
  const double columns = source.image.width, rows = source.image.height;
  return {std::clamp(whole.x, 0.0, columns) / columns * width_, std::clamp(whole.y, 0.0, rows) / rows * height_};
}

std::uint32_t ChipPieces::chartOfWedge(std::uint32_t wedge) const {
  return static_cast<std::uint32_t>(texCoordsOf(patch_, set_)[wedge].x);
}

TexelRect ChipPieces::rectOf(std::span<const std::uint32_t> triangles) const {
  double left = width_, top = height_, right = 0, bottom = 0;
  for (const std::uint32_t triangle : triangles)
    for (const TexelPoint& point : pointsOf(triangle)) {
      left = std::min(left, point.x), right = std::max(right, point.x);
      top = std::min(top, point.y), bottom = std::max(bottom, point.y);
    }
  const auto span = [](double low, double high, double count) {
    const double first = std::clamp(std::floor(low), 0.0, std::ceil(count) - 1);
    const double end = std::clamp(std::ceil(high), first + 1, std::ceil(count));
    return std::pair(static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end - first));
  };
  const auto [x, width] = span(left, right, width_);
  const auto [y, height] = span(top, bottom, height_);
  return {x, y, width, height};
}

void ChipPieces::add(ChipPiece piece) {
  piece.rect = rectOf(piece.triangles);
  if (!divide(piece))
    pieces_.push_back(std::move(piece));
}

/// Divides a piece that leaves much of its rectangle empty, where that saves most.
bool ChipPieces::divide(const ChipPiece& piece) {
  if (piece.triangles.size() < minDividedTriangles)
    return false;
  double covered = 0;
  for (const std::uint32_t triangle : piece.triangles)
    covered += texelArea(triangle);
  const double area = chipArea(chipSize(piece.rect));
  if (area <= maxRectShare * covered)
    return false;
  double smallest = maxDividedShare * area;
  std::vector<std::uint32_t> low, high;
  for (double TexelPoint::*const axis : {&TexelPoint::x, &TexelPoint::y}) {
    std::vector<std::pair<double, std::uint32_t>> keys; // centres
    for (const std::uint32_t triangle : piece.triangles) {
      const auto [a, b, c] = pointsOf(triangle);
      keys.emplace_back(a.*axis + b.*axis + c.*axis, triangle);
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> sorted;
    std::ranges::transform(keys, std::back_inserter(sorted), [](const auto& key) { return key.second; });
    for (std::size_t part = 1; part < dividedParts; ++part) {
      const std::span all(sorted);
      const std::size_t middle = sorted.size() * part / dividedParts;
      const double divided =
          chipArea(chipSize(rectOf(all.first(middle)))) + chipArea(chipSize(rectOf(all.subspan(middle))));
      if (divided > smallest)
        continue;
      smallest = divided;
      low.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(middle));
      high.assign(all.begin() + static_cast<std::ptrdiff_t>(middle), all.end());
    }
  }
  if (low.empty())
    return false;
  add({piece.chart, std::move(low), {}});
  add({piece.chart, std::move(high), {}});
  return true;
}

} // namespace imgeo
