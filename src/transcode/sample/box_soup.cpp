#include "transcode/sample/box_soup.h"

#include "transcode/sample/mix_bits.h"

#include <algorithm>
#include <iterator>

namespace imgeo {

namespace {

constexpr Vec3d roomSize{6, 6, 3};

/// What each room has before its small parts, in metres from its corner; gaps keep neighbours apart.
constexpr Box3d structure[] = {
    {{0.05, 0.05, 0}, {5.95, 5.95, 0.25}},  // slab
    {{0.05, 0.05, 0.3}, {5.95, 0.2, 2.95}}, // wall along x
    {{0.05, 0.25, 0.3}, {0.2, 4.6, 2.95}},  // wall along y, with a door beside it
    {{5.5, 5.5, 0.3}, {5.9, 5.9, 2.95}},    // column
    {{0.3, 5.5, 2.6}, {5.4, 5.8, 2.95}},    // beam
};

/// A number from 0 to 1 for each box, seed and purpose.
double shareOf(std::uint64_t box, std::uint64_t seed, std::uint64_t purpose) {
  return static_cast<double>(mixBits(mixBits(box + 1) + seed + (purpose << 40)) >> 11) * 0x1p-53;
}

} // namespace

BoxSoup::BoxSoup(std::uint64_t count, std::uint64_t seed) : seed_(seed) {
  const std::uint64_t rooms = (count + boxesPerRoom - 1) / boxesPerRoom;
  while (side_ * side_ * std::max<std::uint64_t>(1, side_ / 4) < rooms) // four times as wide as it has storeys
    ++side_;
}

Box3d BoxSoup::box(std::uint64_t number) const {
  const std::uint64_t room = number / boxesPerRoom, part = number % boxesPerRoom;
  const std::uint64_t row = room / side_ % side_, storey = room / (side_ * side_);
  const Vec3d corner{roomSize.x * static_cast<double>(room % side_), roomSize.y * static_cast<double>(row),
                     roomSize.z * static_cast<double>(storey)};
  if (part < std::size(structure))
    return {corner + structure[part].min, corner + structure[part].max};
  // Many parts are small, few large; some are long or flat.
  const double share = shareOf(number, seed_, 0), size = share * share * share;
  Box3d result;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge =
        std::max(0.01, size * (0.1 + 0.9 * shareOf(number, seed_, 1 + static_cast<std::uint64_t>(axis))));
    const double low =
        0.3 + (roomSize[axis] - 0.4 - edge) * shareOf(number, seed_, 4 + static_cast<std::uint64_t>(axis));
    result.min[axis] = corner[axis] + low;
    result.max[axis] = corner[axis] + low + edge;
  }
  return result;
}

} // namespace imgeo
