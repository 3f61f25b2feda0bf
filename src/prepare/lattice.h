#pragma once
// One integer lattice per source mesh, shared by all its patches, so that
// borders agree at every precision.

#include "base/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace imgeo {

/// Lattice point q stands for origin + q * step, on all three axes alike in
/// everything that imgeo writes; other writers' boxes are no cubes, and their
/// steps differ by `stretch`. Quantised coordinates are 0 .. 2^bits - 1.
struct Lattice {
  Vec3d origin;            ///< the source box's minimum
  double step = 1;         ///< longest edge / (2^bits - 1); 1 for a box without extent
  std::uint32_t bits = 16; ///< 8..32
  Vec3d stretch{1, 1, 1};  ///< an axis's step over the longest; 0 where the box is flat

  std::uint32_t maximum() const { return static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1); }
  Vec3d point(Vec3u q) const { return origin + Vec3d{q.x * stretch.x, q.y * stretch.y, q.z * stretch.z} * step; }
  friend bool operator==(const Lattice&, const Lattice&) = default;
};

Lattice latticeFor(const Box3d& box, std::uint32_t bits);

/// The nearest lattice point of each position; the error is at most step / 2 an axis.
std::vector<Vec3u> quantise(std::span<const Vec3f> positions, const Lattice& lattice);

} // namespace imgeo
