#pragma once
// Sites of other programs: they do not state how the input was prepared, and round differently.

#include "containers/container_reader.h"

#include <span>
#include <vector>

namespace imgeo {

/// Distance from the middle between two lattice points, in steps along an axis, within which another program may round
/// to either: aopt computed in single precision.
inline constexpr double foreignRounding = 0.05;

/// Lattice points of positions. A position near the middle between two lattice points gets the one at which `site` has
/// a vertex.
std::vector<Vec3u> quantiseLike(const std::vector<IndexedPatch>& site, std::span<const Vec3f> positions,
                                const Lattice& lattice);

} // namespace imgeo
