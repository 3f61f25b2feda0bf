#pragma once
// Passes over the pieces of a mesh of the source: its survey, and the lattice on which its positions lie.

#include "prepare/source_lattice.h"
#include "transcode/out_of_core/passes.h"
#include "transcode/out_of_core/survey.h"

#include <optional>
#include <span>

namespace imgeo {

/// A mesh of the source, and how its pieces are read.
struct SourcePieces {
  const ChunkedMesh& mesh;
  const ImportOptions& importOptions;
  const ConvertOptions& options; ///< resolved
  const WorkFolder& work;
  std::size_t atOnce = 1; ///< pieces that are read in parallel
};

/// The survey of the whole mesh, by one pass.
Survey surveySource(const SourcePieces& pieces, Passes& passes);

/// The lattice on which all positions of the mesh lie already, by at most two passes. `sample`: of its positions.
std::optional<SourceLattice> findSourceLattice(const SourcePieces& pieces, Passes& passes,
                                               std::span<const Vec3f> sample, const Lattice& requested);

} // namespace imgeo
