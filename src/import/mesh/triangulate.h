#pragma once
// Triangulation of polygons.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Concave polygons of more corners become a fan.
inline constexpr std::size_t maxEarClippedCorners = 512;

/// Cuts a polygon of n corners (at least 3) into n - 2 triangles of the same orientation and appends their corners, as
/// indices into `ring`, to `triangles`. A convex polygon becomes a fan about its first corner; a concave one is
/// ear-clipped in the plane of its Newell normal. Polygons that cross themselves or have no area also give n - 2
/// triangles. Returns false where a concave polygon had more than maxEarClippedCorners corners and became a fan.
/// web/src/tessellate/earClipping.ts gives the same triangles; vectors/tessellation/earClipping.json tests both.
bool triangulate(std::span<const Vec3f> ring, std::vector<std::uint32_t>& triangles);

} // namespace imgeo
