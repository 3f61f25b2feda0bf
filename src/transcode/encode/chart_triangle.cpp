#include "transcode/encode/chart_triangle.h"

#include "prepare/index_hash_table.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace imgeo {

std::uint64_t identityOf(const TexturedTriangle& triangle) {
  std::uint64_t hash = 0;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const Vec3u& point = triangle.points[corner];
    const auto bits = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value + 0.0f)}; };
    hash = mixHash(hash, std::uint64_t{point.x} << 32 | point.y);
    hash = mixHash(hash, std::uint64_t{point.z} << 32 | bits(triangle.texCoords[corner].x));
    hash = mixHash(hash, bits(triangle.texCoords[corner].y));
  }
  return hash;
}

ChartTriangle::ChartTriangle(const TexturedTriangle& triangle, const ChartProjection& projection,
                             const TexelRect& rect) {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec2<double> at = projection.texelOf(triangle.points[i]);
    points_[i] = {std::llround(at.x * unit), std::llround(at.y * unit)};
  }
  const auto& [a, b, c] = points_;
  area_ = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  const auto range = [&](std::int64_t Point::*axis, std::int64_t first, std::int64_t count) {
    const auto [low, high] = std::minmax({a.*axis, b.*axis, c.*axis});
    return std::pair(std::max(low / unit, first), std::min((std::max(high, low + 1) - 1) / unit + 1, first + count));
  };
  columns_ = range(&Point::x, rect.left, rect.width);
  rows_ = range(&Point::y, rect.top, rect.height);
}

bool ChartTriangle::contains(std::int64_t x, std::int64_t y) const {
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &from = points_[i], &to = points_[(i + 1) % 3];
    const std::int64_t dx = to.x - from.x, dy = to.y - from.y, side = dx * (y - from.y) - dy * (x - from.x);
    const bool ownsEdge = dy > 0 || (dy == 0 && dx < 0); // the triangle on the other side does not
    if (side < 0 || (side == 0 && !ownsEdge))
      return false;
  }
  return true;
}

std::array<double, 3> ChartTriangle::sharesAt(double x, double y) const {
  const auto& [a, b, c] = points_;
  const double px = x * unit, py = y * unit, area = static_cast<double>(area_);
  const auto side = [&](const Point& from, const Point& to) {
    return static_cast<double>(to.x - from.x) * (py - static_cast<double>(from.y)) -
           static_cast<double>(to.y - from.y) * (px - static_cast<double>(from.x));
  };
  const double ofA = side(b, c) / area, ofB = side(c, a) / area;
  return {ofA, ofB, 1 - ofA - ofB};
}

std::array<double, 3> ChartTriangle::nearestShares(double x, double y, double& distance) const {
  std::array<double, 3> nearest{};
  distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Point &from = points_[i], &to = points_[(i + 1) % 3];
    const double dx = static_cast<double>(to.x - from.x) / unit, dy = static_cast<double>(to.y - from.y) / unit;
    const double px = x - static_cast<double>(from.x) / unit, py = y - static_cast<double>(from.y) / unit;
    const double squared = dx * dx + dy * dy;
    const double share = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.0, 1.0) : 0;
    const double away = std::hypot(px - share * dx, py - share * dy);
    if (away < distance) {
      distance = away;
      nearest = {};
      nearest[i] = 1 - share, nearest[(i + 1) % 3] = share;
    }
  }
  return nearest;
}

} // namespace imgeo
