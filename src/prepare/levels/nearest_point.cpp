#include "prepare/levels/nearest_point.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

namespace imgeo {

namespace {

/// Ranges of fewer points are searched one by one.
constexpr std::size_t leafSize = 12;

} // namespace

NearestPoint::NearestPoint(std::vector<Vec3u> points) : points_(std::move(points)), axes_(points_.size()) {
  assert(!points_.empty());
  build(0, points_.size());
}

void NearestPoint::build(std::size_t begin, std::size_t end) {
  if (end - begin <= leafSize)
    return;
  Box3d box;
  for (std::size_t i = begin; i < end; ++i)
    box.add(Vec3d(points_[i]));
  const Vec3d size = box.size();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t middle = begin + (end - begin) / 2;
  const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(begin), at(middle), at(end),
                   [axis](const Vec3u& a, const Vec3u& b) { return a[axis] < b[axis]; });
  axes_[middle] = axis;
  build(begin, middle);
  build(middle + 1, end);
}

void NearestPoint::search(std::size_t begin, std::size_t end, const Vec3u& point, double enough, double& square) const {
  const auto compare = [&](std::size_t i) {
    const Vec3d difference = Vec3d(points_[i]) - Vec3d(point);
    square = std::min(square, dot(difference, difference));
  };
  if (end - begin <= leafSize) {
    for (std::size_t i = begin; i < end; ++i)
      compare(i);
    return;
  }
  const std::size_t middle = begin + (end - begin) / 2;
  compare(middle);
  const double offset = static_cast<double>(point[axes_[middle]]) - points_[middle][axes_[middle]];
  const bool isBelow = offset < 0;
  if (isBelow)
    search(begin, middle, point, enough, square);
  else
    search(middle + 1, end, point, enough, square);
  if (offset * offset >= square || square <= enough)
    return;
  if (isBelow)
    search(middle + 1, end, point, enough, square);
  else
    search(begin, middle, point, enough, square);
}

double NearestPoint::distanceOf(const Vec3u& point) const {
  double square = std::numeric_limits<double>::infinity();
  search(0, points_.size(), point, 0, square);
  return std::sqrt(square);
}

double NearestPoint::farther(double distance, const Vec3u& point) const {
  double square = std::numeric_limits<double>::infinity();
  search(0, points_.size(), point, distance * distance, square);
  return std::max(distance, std::sqrt(square));
}

} // namespace imgeo
