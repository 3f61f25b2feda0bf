#pragma once
// Sites of other programs, which do not say how their input was prepared and
// round in their own arithmetic.

#include "containers/container.h"

#include <span>
#include <vector>

namespace imgeo {

/// By how many steps an axis other programs may be off the nearest lattice point and
/// still be taken at their word: aopt computed in single precision.
inline constexpr double foreignRounding = 0.05;

/// The lattice points of positions. Where one lies so near to the middle between two
/// that roundings decide, the one at which `site` has a vertex.
std::vector<Vec3u> quantiseLike(const std::vector<IndexedPatch>& site, std::span<const Vec3f> positions,
                                const Lattice& lattice);

} // namespace imgeo
