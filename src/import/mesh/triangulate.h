#pragma once
// Polygons -> triangles.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Concave polygons of more corners are cut as a fan.
inline constexpr std::size_t kMaxEarClippedCorners = 512;

/// Cuts a polygon of n corners (at least 3) into n - 2 triangles of its
/// orientation and appends their corners, as places in `ring`, to `triangles`. A
/// convex polygon becomes a fan about its first corner; a concave one is clipped
/// ear by ear in the plane of its Newell normal. Polygons that cross themselves
/// or have no area still give n - 2 triangles. Returns false where a concave
/// polygon was too large for that and became a fan.
bool triangulate(std::span<const Vec3f> ring, std::vector<std::uint32_t>& triangles);

} // namespace imgeo
