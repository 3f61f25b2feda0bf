#include "prepare/lattice.h"

#include "base/parallel.h"

#include <cassert>

namespace imgeo {

Lattice latticeFor(const Box3d& box, std::uint32_t bits) {
  assert(bits >= 8 && bits <= 32);
  Lattice lattice;
  lattice.bits = bits;
  if (!box.empty())
    lattice.origin = box.min;
  if (box.longestEdge() > 0)
    lattice.step = box.longestEdge() / lattice.maximum();
  return lattice;
}

std::vector<Vec3u> quantise(std::span<const Vec3f> positions, const Lattice& lattice) {
  std::vector<Vec3u> result(positions.size());
  const double maximum = lattice.maximum();
  parallelForBlocks(positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3d offset = Vec3d(positions[i]) - lattice.origin;
      for (int axis = 0; axis < 3; ++axis) {
        // Positions outside of the lattice's box are clamped to it.
        const double step = lattice.step * lattice.stretch[axis];
        const double steps = step > 0 ? std::clamp(offset[axis] / step, 0.0, maximum) : 0;
        result[i][axis] = static_cast<std::uint32_t>(steps + 0.5);
      }
    }
  });
  return result;
}

} // namespace imgeo
