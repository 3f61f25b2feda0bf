#pragma once
// Chooses some points of a cloud by blue noise: no two of them are near each other, and none of the others is far from
// all of them (a maximal Poisson-disk sample, by darts that are thrown in the order of a hash).

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Chooses at most `maxKept` points, and at least nine tenths of that where the radius of the disks can be chosen so;
/// all points where there are no more. `maxKept` is at least the number of different `parts`, into which the points are
/// divided. Chosen points are at least a radius apart, but for some at the borders of parts; the others are nearer than
/// that to one of their part, so that each part has a chosen one. Coordinates are below 2^24. Returns for each point
/// whether it is chosen. Does not depend on the order of points, except for those at the same position, of which the
/// first of a part is chosen.
std::vector<bool> choosePoissonDisk(std::span<const Vec3u> points, std::span<const std::uint32_t> parts,
                                    std::size_t maxKept);

} // namespace imgeo
