#pragma once
// The lattice on which a mesh's positions already lie: those of scanners that count steps, of files with few decimals
// and of meshes that another program has quantised. Positions on it are exact and need fewer bits.

#include "prepare/lattice.h"

#include <cmath>
#include <optional>
#include <span>

namespace imgeo {

struct SourceLattice {
  Lattice lattice;  ///< with the same step on all axes and 8 .. 32 bits
  double error = 0; ///< the largest distance of a position from its lattice point, along an axis
};

/// The coarsest lattice whose points are all positions, if there is one that is not finer than `requested` and no
/// position is farther from it than half a step of `requested`. Nothing for fewer than 256 positions: it would save
/// less than it takes to state. The step is estimated from `sample`, which is all or some of the positions.
std::optional<SourceLattice> findSourceLattice(std::span<const Vec3f> sample, std::span<const Vec3f> positions,
                                               const Lattice& requested);
inline std::optional<SourceLattice> findSourceLattice(std::span<const Vec3f> positions, const Lattice& requested) {
  return findSourceLattice(positions, positions, requested);
}

// The same in steps, for positions that are not at hand all at once.

/// The signed distances of positions from their lattice points, along each axis.
struct LatticeResiduals {
  Vec3d min{INFINITY, INFINITY, INFINITY}, max{-INFINITY, -INFINITY, -INFINITY};

  void add(const LatticeResiduals& others);
  /// The largest one without its sign.
  double largest() const;
};

LatticeResiduals residualsOn(std::span<const Vec3f> positions, const Lattice& lattice);

/// 1. A lattice on which the sampled positions may lie.
std::optional<Lattice> guessSourceLattice(std::span<const Vec3f> sample, const Lattice& requested);
/// 2. The guess with its origin in the middle of the residuals of all positions, and round numbers.
Lattice centeredLattice(const Lattice& guess, const LatticeResiduals& residuals, const Lattice& requested);
/// 3. The result, by the residuals on the centered lattice.
std::optional<SourceLattice> acceptedLattice(const Lattice& centered, const LatticeResiduals& residuals,
                                             const Lattice& requested);

} // namespace imgeo
