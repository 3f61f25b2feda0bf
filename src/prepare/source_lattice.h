#pragma once
// The lattice on which a mesh's positions already lie: those of scanners that count steps, of files with few decimals
// and of meshes that another program has quantised. Positions on it are exact and need fewer bits.

#include "prepare/lattice.h"

#include <optional>
#include <span>

namespace imgeo {

struct SourceLattice {
  Lattice lattice;  ///< with the same step on all axes and 8 .. 32 bits
  double error = 0; ///< the largest distance of a position from its lattice point, along an axis
};

/// The coarsest lattice whose points are all positions, if there is one that is not finer than `requested` and no
/// position is farther from it than half a step of `requested`. Nothing for meshes of fewer than 256 positions: it
/// would save less than it takes to state.
std::optional<SourceLattice> findSourceLattice(std::span<const Vec3f> positions, const Lattice& requested);

} // namespace imgeo
