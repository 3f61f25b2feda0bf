#pragma once
// The axes along which levels are cut into groups.

#include "base/vec.h"

#include <array>
#include <cstdint>

namespace imgeo {

/// The axes along which a level is cut. Levels above one another have different ones, so that borders of groups, where
/// nothing is simplified, do not lie at the same position on both.
enum class GroupFrame : std::uint8_t {
  straight, ///< x, y, z
  turned,   ///< turned by 0.75 radians about (1, 1, 1)
};

/// The frame of a level.
inline GroupFrame frameOfLevel(std::uint32_t level) {
  return level % 2 == 0 ? GroupFrame::straight : GroupFrame::turned;
}

/// Integer coordinates in a frame.
using FrameKey = Vec3<std::int64_t>;

/// The axes of a frame as integers, so that keys are the same on every machine.
inline std::array<FrameKey, 3> axesOf(GroupFrame frame) {
  if (frame == GroupFrame::straight)
    return {FrameKey{1, 0, 0}, FrameKey{0, 1, 0}, FrameKey{0, 0, 1}};
  // Rodrigues' rotation by 0.75 about (1, 1, 1), times 2^20: the circulant matrix of these three numbers.
  constexpr std::int64_t a = 861013, b = -318880, c = 506443;
  return {FrameKey{a, b, c}, FrameKey{c, a, b}, FrameKey{b, c, a}};
}

/// Thrice the centroid of a triangle of lattice points in a frame.
inline FrameKey keyOfTriangle(const std::array<FrameKey, 3>& axes, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const FrameKey sum = FrameKey(a) + FrameKey(b) + FrameKey(c);
  return {dot(axes[0], sum), dot(axes[1], sum), dot(axes[2], sum)};
}

/// Thrice a lattice point in a frame: comparable with the keys of triangles.
inline FrameKey keyOfPoint(const std::array<FrameKey, 3>& axes, const Vec3f& point) {
  return keyOfTriangle(axes, point, point, point);
}

} // namespace imgeo
