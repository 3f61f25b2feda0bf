#include "prepare/instances/point_index.h"

#include "prepare/index_hash_table.h"

#include <cmath>

namespace imgeo {

namespace {

constexpr std::uint32_t endOfChain = UINT32_MAX;

std::uint64_t hashOfCell(const Vec3<std::int64_t>& cell) {
  return mixHash(mixHash(static_cast<std::uint64_t>(cell.x), static_cast<std::uint64_t>(cell.y)),
                 static_cast<std::uint64_t>(cell.z));
}

} // namespace

PointIndex::PointIndex(std::span<const Vec3f> points, double within)
    : points_(points), within_(within), next_(points.size(), endOfChain) {
  Box3d box;
  for (const Vec3f& point : points)
    box.add(Vec3d(point));
  origin_ = box.empty() ? Vec3d{} : box.min;
  const double mean = box.longestEdge() / std::cbrt(static_cast<double>(std::max<std::size_t>(points.size(), 1)));
  cellSize_ = std::max({4 * within, mean / 2, box.longestEdge() / (1 << 30)});
  first_.reserve(points.size());
  for (auto i = static_cast<std::uint32_t>(points.size()); i-- > 0;) { // from the back, for ascending chains
    const auto [entry, isNew] = first_.try_emplace(hashOfCell(cellOf(Vec3d(points[i]))), i);
    if (!isNew)
      next_[i] = entry->second, entry->second = i;
  }
}

Vec3<std::int64_t> PointIndex::cellOf(const Vec3d& at) const {
  const Vec3d cell = (at - origin_) * (1 / cellSize_);
  return {std::int64_t(std::floor(cell.x)), std::int64_t(std::floor(cell.y)), std::int64_t(std::floor(cell.z))};
}

std::optional<PointIndex::Found> PointIndex::nearest(const Vec3d& at) const {
  const Vec3d reach{within_, within_, within_};
  const Vec3<std::int64_t> low = cellOf(at - reach), high = cellOf(at + reach);
  std::optional<Found> best;
  for (std::int64_t x = low.x; x <= high.x; ++x)
    for (std::int64_t y = low.y; y <= high.y; ++y)
      for (std::int64_t z = low.z; z <= high.z; ++z) {
        const auto chain = first_.find(hashOfCell({x, y, z}));
        if (chain == first_.end())
          continue;
        for (std::uint32_t i = chain->second; i != endOfChain; i = next_[i]) {
          const double distance = length(Vec3d(points_[i]) - at);
          if (distance <= within_ &&
              (!best || distance < best->distance || (distance == best->distance && i < best->index)))
            best = Found{i, distance};
        }
      }
  return best;
}

} // namespace imgeo
