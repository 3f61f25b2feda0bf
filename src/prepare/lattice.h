#pragma once
// Quantisation of positions: one integer lattice for each mesh, shared by all its patches, so that their borders agree
// at every precision.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Lattice point q is at origin + q * step * stretch. Quantised coordinates are 0 .. 2^bits - 1. imgeo writes lattices
/// of the same step on all axes; the decode boxes of other writers are not always cubes, and their steps differ by
/// `stretch`.
struct Lattice {
  Vec3d origin;            ///< the source box's minimum
  double step = 1;         ///< longest edge / (2^bits - 1); 1 for a box without extent
  std::uint32_t bits = 16; ///< 8..32
  Vec3d stretch{1, 1, 1};  ///< by axis: the axis' step divided by `step`; 0 on an axis without extent

  std::uint32_t maximum() const { return static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1); }
  Vec3d point(Vec3u q) const { return origin + Vec3d{q.x * stretch.x, q.y * stretch.y, q.z * stretch.z} * step; }
  friend bool operator==(const Lattice&, const Lattice&) = default;
};

/// The lattice of a box, with the same step on all axes. `bits` is 8..32.
Lattice latticeFor(const Box3d& box, std::uint32_t bits);

/// The nearest lattice point of each position. Positions within the lattice's box move by at most step / 2 on each
/// axis; others are clamped to the box.
std::vector<Vec3u> quantise(std::span<const Vec3f> positions, const Lattice& lattice);

} // namespace imgeo
