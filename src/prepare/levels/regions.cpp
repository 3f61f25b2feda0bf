#include "prepare/levels/regions.h"

#include <algorithm>
#include <array>
#include <optional>

namespace imgeo {

namespace {

constexpr std::uint64_t maxSampledElements = std::uint64_t{1} << 18;

/// A number that looks random (the finalizer of MurmurHash3).
std::uint64_t scrambled(std::uint64_t value) {
  value = (value ^ value >> 33) * 0xff51afd7ed558ccdu;
  value = (value ^ value >> 33) * 0xc4ceb9fe1a85ec53u;
  return value ^ value >> 33;
}

/// The axes, along the longest of which keys spread first.
std::array<int, 3> axesByLength(std::span<const FrameKey> keys) {
  FrameKey low = keys[0], high = keys[0];
  for (const FrameKey& key : keys)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], key[axis]);
      high[axis] = std::max(high[axis], key[axis]);
    }
  const FrameKey size = high - low;
  std::array<int, 3> axes{0, 1, 2};
  std::ranges::stable_sort(axes, [&](int a, int b) { return size[a] > size[b]; });
  return axes;
}

struct Cut {
  int axis;
  std::int64_t key; ///< keys below it come first
  std::size_t belowCount;
};

/// Orders keys so that about `middle` of them come first, divided by a plane from the others; keys in a plane stay
/// together. Nothing if all keys are equal.
std::optional<Cut> cutOf(std::span<FrameKey> keys, std::size_t middle) {
  for (const int axis : axesByLength(keys)) {
    const auto isBefore = [&](const FrameKey& a, const FrameKey& b) { return a[axis] < b[axis]; };
    std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(middle), keys.end(), isBefore);
    const std::int64_t key = keys[middle][axis];
    for (const std::int64_t first : {key, key + 1}) {
      const auto above =
          std::partition(keys.begin(), keys.end(), [&](const FrameKey& each) { return each[axis] < first; });
      if (above != keys.begin() && above != keys.end())
        return Cut{axis, first, static_cast<std::size_t>(above - keys.begin())};
    }
  }
  return std::nullopt;
}

} // namespace

std::uint64_t sampledElementCount(std::uint64_t elementCount) {
  return std::min(elementCount, maxSampledElements);
}

std::uint64_t sampledElement(std::uint64_t i, std::uint64_t elementCount) {
  // Counts are below 2^40, so that products do not overflow.
  const std::uint64_t samples = sampledElementCount(elementCount);
  const std::uint64_t begin = i * elementCount / samples, end = (i + 1) * elementCount / samples;
  return begin + scrambled(i) % (end - begin);
}

RegionTree::RegionTree(std::vector<FrameKey> sample, std::uint64_t triangleCount, std::uint32_t regionTriangles)
    : regionCount_(0) {
  build(sample, {sample.size(), (triangleCount + regionTriangles - 1) / regionTriangles});
}

std::uint32_t RegionTree::build(std::span<FrameKey> sample, const Density& density) {
  const auto number = static_cast<std::uint32_t>(nodes_.size());
  nodes_.emplace_back();
  const std::uint64_t parts = (sample.size() * density.parts + density.samples - 1) / density.samples;
  const std::optional<Cut> cut = parts > 1 ? cutOf(sample, sample.size() * (parts / 2) / parts) : std::nullopt;
  if (!cut) {
    nodes_[number].region = regionCount_++;
    return number;
  }
  const std::uint32_t below = build(sample.first(cut->belowCount), density);
  const std::uint32_t above = build(sample.subspan(cut->belowCount), density);
  nodes_[number] = {cut->axis, cut->key, below, above, 0};
  return number;
}

} // namespace imgeo
